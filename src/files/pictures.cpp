#include "files/pictures.h"

#include <array>

namespace edgewise::tools {

Image picture_of(const Framebuffer& frame, Payload payload) {
  // 2^24 over the golden ratio. A multiplication by it moves neighbouring numbers far apart (Knuth, The Art
  // of Computer Programming, volume 3, section 6.4). It is odd, so it permutes the 24-bit numbers.
  constexpr std::uint32_t kSpread = 0x9E3779;
  Image image = to_image(frame);
  if (payload == Payload::colour) return image;
  // The background's id + 1 wraps to 0, which is black.
  for (std::uint32_t& pixel : image.pixels) pixel = 0xFF000000u | ((pixel + 1u) * kSpread & 0xFFFFFFu);
  return image;
}

Image picture_of_hits(std::span<const std::uint32_t> hits, int width, int height) {
  constexpr std::array<std::uint32_t, 4> kColours{rgb(0, 0, 0), rgb(128, 128, 128), rgb(255, 210, 0),
                                                  rgb(255, 0, 0)};
  Image image{width, height, {}};
  image.pixels.reserve(hits.size());
  for (const std::uint32_t n : hits) image.pixels.push_back(kColours[n < 3 ? n : 3]);
  return image;
}

Image picture_of_difference(const Framebuffer& a, const Framebuffer& b, Payload payload) {
  Image image = difference(picture_of(a, payload), picture_of(b, payload)).picture;
  auto pixel = image.pixels.begin();
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x, ++pixel)
      if (a.payload_row(y)[x] == b.payload_row(y)[x] && a.depth_row(y)[x] != b.depth_row(y)[x])
        *pixel = rgb(0, 64, 255);
  return image;
}

}  // namespace edgewise::tools

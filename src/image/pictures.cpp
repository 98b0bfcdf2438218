#include "image/pictures.h"

#include <array>

namespace edgewise::tools {

namespace {

// 2^24 over the golden ratio. A multiplication by it moves neighbouring numbers far apart (Knuth, The Art of
// Computer Programming, volume 3, section 6.4). It is odd, so it permutes the 24-bit numbers.
constexpr std::uint32_t kSpread = 0x9E3779;
static_assert(kSpread % 2 == 1);

template <typename PixelAt>
Image build(int width, int height, PixelAt pixel_at) {
  Image image{width, height, {}};
  image.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.push_back(pixel_at(x, y));
  return image;
}

}  // namespace

Image picture_of(const Framebuffer& frame, Payload payload) {
  if (payload == Payload::colour) return to_image(frame);
  // The background's id + 1 wraps to 0, which is black.
  return build(frame.width(), frame.height(), [&](int x, int y) {
    const std::uint32_t code = ((frame.payload_row(y)[x] + 1u) * kSpread) & 0xFFFFFFu;
    return 0xFF000000u | code;
  });
}

Image picture_of_hits(std::span<const std::uint32_t> hits, int width, int height) {
  constexpr std::array<std::uint32_t, 4> kColours{rgb(0, 0, 0), rgb(128, 128, 128), rgb(255, 210, 0),
                                                  rgb(255, 0, 0)};
  return build(width, height, [&](int x, int y) {
    const std::uint32_t n =
        hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    return kColours[n < 3 ? n : 3];
  });
}

Image picture_of_difference(const Framebuffer& a, const Framebuffer& b, Payload payload) {
  Image image = difference(picture_of(a, payload), picture_of(b, payload)).picture;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const bool payload_differs = a.payload_row(y)[x] != b.payload_row(y)[x];
      const bool depth_differs = a.depth_row(y)[x] != b.depth_row(y)[x];
      if (!payload_differs && depth_differs)
        image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width()) +
                     static_cast<std::size_t>(x)] = rgb(0, 64, 255);
    }
  return image;
}

}  // namespace edgewise::tools

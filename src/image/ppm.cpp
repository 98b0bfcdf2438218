#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "image/format.h"
#include "image/netpbm.h"

namespace edgewise {

Image to_image(const ConstFrameView& frame) {
  if (frame.payload == nullptr) throw std::invalid_argument("a frame without payloads is no picture");
  Image image{frame.width, frame.height, {}};
  image.pixels.reserve(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y) {
    const std::uint32_t* row = frame.payload + y * frame.stride;
    image.pixels.insert(image.pixels.end(), row, row + frame.width);
  }
  return image;
}

std::vector<unsigned char> rgb_bytes(const Image& image) {
  std::vector<unsigned char> bytes(image.pixels.size() * 3);
  unsigned char* out = bytes.data();
  for (const std::uint32_t pixel : image.pixels) {
    *out++ = static_cast<unsigned char>(pixel);
    *out++ = static_cast<unsigned char>(pixel >> 8);
    *out++ = static_cast<unsigned char>(pixel >> 16);
  }
  return bytes;
}

void write_ppm(std::ostream& out, const Image& image) {
  const std::vector<unsigned char> bytes = rgb_bytes(image);
  out << "P6\n" << image.width << ' ' << image.height << "\n255\n";
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Samples read_ppm(const std::filesystem::path& path, InputFile file) {
  netpbm::Reader reader(path, std::move(file), "P2, P3, P5 or P6");
  const netpbm::Size size = reader.size();
  const std::uint64_t maximum = reader.integer("maximum");
  if (maximum < 1 || maximum > 65535) throw FileError(path, "the maximum must be 1 to 65535");
  const bool plain = reader.is_plain(), grey = reader.kind() == '2' || reader.kind() == '5';
  Samples image{size.width, size.height, maximum > 255, grey, {}};
  const std::size_t channels = grey ? 1 : 3, width = image.deep ? 2 : 1;
  std::vector<unsigned char> bytes;
  if (plain)
    reader.begin_plain(size.pixels() * channels);
  else
    bytes = reader.samples<unsigned char>(size.pixels() * channels * width);
  // As 16 bits. Samples of up to 8 bits keep their ratio to 255.
  const std::uint32_t full = image.deep ? 65535 : 255;
  const auto sample = [&](std::size_t i) {
    const std::uint64_t value = plain        ? reader.integer("sample")
                                : image.deep ? bytes[2 * i] * 256u + bytes[2 * i + 1]
                                             : bytes[i];
    if (value > maximum)
      throw FileError(path, "has a sample of " + std::to_string(value) + ", more than its maximum of " +
                                std::to_string(maximum));
    return static_cast<std::uint16_t>((value * full + maximum / 2) / maximum * (65535 / full));
  };
  image.pixels.reserve(size.pixels());
  for (std::size_t i = 0; i < channels * size.pixels(); i += channels) {
    const std::uint16_t r = sample(i), g = grey ? r : sample(i + 1), b = grey ? r : sample(i + 2);
    image.pixels.push_back({r, g, b, 65535});
  }
  if (plain) reader.end_plain();
  return image;
}

}  // namespace edgewise

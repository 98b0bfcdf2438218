#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "image/format.h"
#include "image/netpbm.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

// A sample of `bits` bits, of which the largest value is `maximum`, as 16 bits.
std::uint16_t scaled(const fs::path& path, std::uint32_t sample, std::uint32_t maximum, int bits) {
  if (sample > maximum)
    throw file_error(path, "has a sample of " + std::to_string(sample) + ", more than its maximum of " +
                               std::to_string(maximum));
  const std::uint32_t full = bits == 8 ? 255 : 65535;
  return static_cast<std::uint16_t>((sample * full + maximum / 2) / maximum * (65535 / full));
}

}  // namespace

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

Samples read_ppm(const fs::path& path, InputFile file) {
  netpbm::Reader reader(path, std::move(file), "P6");
  const netpbm::Size size = reader.size();
  const std::uint64_t largest = reader.integer();
  if (largest < 1 || largest > 65535) throw file_error(path, "the maximum must be 1 to 65535");
  const auto maximum = static_cast<std::uint32_t>(largest);
  Samples image{size.width, size.height, maximum > 255, {}};
  const std::size_t width = image.deep ? 2 : 1;
  const auto bytes = reader.samples<unsigned char>(size.pixels() * 3 * width);
  image.pixels.reserve(size.pixels());
  const auto channel = [&](std::size_t i) {
    return image.deep ? scaled(path, bytes[2 * i] * 256u + bytes[2 * i + 1], maximum, 16)
                      : scaled(path, bytes[i], maximum, 8);
  };
  for (std::size_t i = 0; i < 3 * size.pixels(); i += 3)
    image.pixels.push_back({channel(i), channel(i + 1), channel(i + 2)});
  return image;
}

}  // namespace edgewise

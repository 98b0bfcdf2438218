// PNG uses libpng's simplified interface, which needs no setjmp here. PPM (P6) is read and written directly.
#include "edgewise/image.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/atomic_file.h"
#include "core/file_extension.h"
#include "core/input_file.h"
#include "edgewise/contract.h"
#include "image/netpbm.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

// libpng's bytes R, G, B, A are then the integer 0xAABBGGRR.
static_assert(std::endian::native == std::endian::little);

struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

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

void write_png(std::ostream& out, const fs::path& path, const Image& image) {
  PngImage png;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const std::vector<unsigned char> bytes = rgb_bytes(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  const auto encoded = std::make_unique_for_overwrite<char[]>(size);
  if (!png_image_write_to_memory(&png, encoded.get(), &size, 0, bytes.data(), 0, nullptr))
    throw file_error(path, png.message);
  out.write(encoded.get(), static_cast<std::streamsize>(size));
}

Image read_png(const fs::path& path) {
  open_input(path);
  PngImage png;
  if (!png_image_begin_read_from_file(&png, path.c_str())) throw file_error(path, png.message);
  const netpbm::Size size = netpbm::checked_size(path, png.width, png.height);
  png.format = PNG_FORMAT_RGBA;
  Image image{size.width, size.height, std::vector<std::uint32_t>(size.pixels())};
  if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr))
    throw file_error(path, png.message);
  for (std::uint32_t& pixel : image.pixels) pixel |= 0xFF000000u;
  return image;
}

void write_ppm(std::ostream& out, const Image& image) {
  const std::vector<unsigned char> bytes = rgb_bytes(image);
  out << "P6\n" << image.width << ' ' << image.height << "\n255\n";
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Image read_ppm(const fs::path& path) {
  netpbm::Reader reader(path, "P6");
  const netpbm::Size size = reader.size();
  const std::uint64_t largest = reader.integer();
  if (largest < 1 || largest > 255) throw file_error(path, "has samples that are not of 8 bits");
  const auto bytes = reader.samples<unsigned char>(size.pixels() * 3);

  const auto channel = [&](std::size_t i) {
    const std::uint32_t sample = bytes[i], maximum = static_cast<std::uint32_t>(largest);
    return (std::min(sample, maximum) * 255 + maximum / 2) / maximum;
  };
  Image image{size.width, size.height, std::vector<std::uint32_t>(size.pixels())};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = 0xFF000000u | channel(3 * i) | channel(3 * i + 1) << 8 | channel(3 * i + 2) << 16;
  return image;
}

std::runtime_error unknown_format(const fs::path& path) {
  return file_error(path, "is neither a .png nor a .ppm");
}

}  // namespace

Image to_image(const ConstFrameView& frame) {
  Image image{frame.width, frame.height, {}};
  image.pixels.reserve(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y) {
    const std::uint32_t* row = frame.payload + y * frame.stride;
    image.pixels.insert(image.pixels.end(), row, row + frame.width);
  }
  return image;
}

DepthMap to_depth_map(const ConstFrameView& frame) {
  DepthMap map{frame.width, frame.height, {}};
  map.depth01.reserve(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x)
      map.depth01.push_back(static_cast<float>(contract::depth01(frame.depth[y * frame.stride + x])));
  return map;
}

bool is_image_path(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".png" || extension == ".ppm";
}

void write_image(const fs::path& path, const Image& image) {
  if (!is_image_path(path)) throw unknown_format(path);
  netpbm::check_pixels(path, image.width, image.height, image.pixels.size());
  AtomicFile file(path);
  if (extension_of(path) == ".png")
    write_png(file.stream(), path, image);
  else
    write_ppm(file.stream(), image);
  file.commit();
}

Image read_image(const fs::path& path) {
  if (!is_image_path(path)) throw unknown_format(path);
  return extension_of(path) == ".png" ? read_png(path) : read_ppm(path);
}

}  // namespace edgewise

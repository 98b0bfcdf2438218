// PNGs are read through libpng's full interface: the simplified one, which writes them, converts colours.
#include "edgewise/image.h"

#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "core/atomic_file.h"
#include "core/input_file.h"
#include "edgewise/contract.h"
#include "edgewise/scene.h"
#include "image/format.h"
#include "image/netpbm.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

struct PngWriter : png_image {
  PngWriter() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngWriter() { png_image_free(this); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
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
  PngWriter png;
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

class PngReader {
 public:
  explicit PngReader(const fs::path& path) : path_(path), file_(open_input(path)) {
    if (png_ != nullptr && info_ != nullptr) return;
    png_destroy_read_struct(&png_, &info_, nullptr);
    throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  Samples read() {
    run([&] {
      png_set_read_fn(png_, this, read_bytes);
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // checked_size() reports large ones
      png_read_info(png_, info_);
    });
    const netpbm::Size size =
        netpbm::checked_size(path_, png_get_image_width(png_, info_), png_get_image_height(png_, info_));
    Samples image{size.width, size.height, png_get_bit_depth(png_, info_) == 16, {}};
    image.pixels.resize(size.pixels());
    run([&] {
      png_set_expand_16(png_);
      png_set_gray_to_rgb(png_);
      png_set_strip_alpha(png_);
      if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);  // a PNG is big-endian
      const int passes = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      for (int pass = 0; pass < passes; ++pass)
        for (std::size_t i = 0; i < size.pixels(); i += static_cast<std::size_t>(size.width))
          png_read_row(png_, reinterpret_cast<png_bytep>(&image.pixels[i]), nullptr);
      png_read_end(png_, nullptr);
    });
    return image;
  }

 private:
  // libpng reports an error by a jump to here, so the calls must not own anything.
  template <typename Calls>
  [[gnu::noinline]] void run(const Calls& calls) {
    if (setjmp(png_jmpbuf(png_)) != 0) throw file_error(path_, message_.data());
    calls();
  }
  static void fail(png_structp png, png_const_charp message) {
    auto& text = static_cast<PngReader*>(png_get_error_ptr(png))->message_;
    std::strncpy(text.data(), message, text.size() - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void read_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& stream = static_cast<PngReader*>(png_get_io_ptr(png))->file_.stream;
    if (!stream.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count)))
      png_error(png, "truncated");
  }

  const fs::path& path_;
  InputFile file_;
  std::array<char, 128> message_{};
  png_structp png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  png_infop info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
};

void write_ppm(std::ostream& out, const Image& image) {
  const std::vector<unsigned char> bytes = rgb_bytes(image);
  out << "P6\n" << image.width << ' ' << image.height << "\n255\n";
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// A sample of `bits` bits, of which the largest value is `maximum`, as 16 bits.
std::uint16_t scaled(const fs::path& path, std::uint32_t sample, std::uint32_t maximum, int bits) {
  if (sample > maximum)
    throw file_error(path, "has a sample of " + std::to_string(sample) + ", more than its maximum of " +
                               std::to_string(maximum));
  const std::uint32_t full = bits == 8 ? 255 : 65535;
  return static_cast<std::uint16_t>((sample * full + maximum / 2) / maximum * (65535 / full));
}

Samples read_ppm(const fs::path& path) {
  netpbm::Reader reader(path, "P6");
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

std::optional<Format> format_of(const fs::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".png") return Format::png;
  if (extension == ".ppm") return Format::ppm;
  if (extension == ".pfm") return Format::pfm;
  return {};
}

std::optional<Format> format_of_input(const fs::path& path) {
  if (!descriptor_of(path)) return format_of(path);
  if (starts_with(path, "\x89PNG")) return Format::png;
  if (starts_with(path, "P6")) return Format::ppm;
  if (starts_with(path, "Pf")) return Format::pfm;
  return {};
}

bool is_image_path(const fs::path& path) {
  const auto format = format_of(path);
  return format && *format != Format::pfm;
}

void write_image(const fs::path& path, const Image& image) {
  if (!is_image_path(path)) throw unknown_format(path);
  write_image(path, image, *format_of(path));
}

void write_image(const fs::path& path, const Image& image, Format format) {
  netpbm::check_pixels(path, image.width, image.height, image.pixels.size());
  AtomicFile file(path);
  if (format == Format::png)
    write_png(file.stream(), path, image);
  else
    write_ppm(file.stream(), image);
  file.commit();
}

Samples read_samples(const fs::path& path) {
  const auto format = format_of_input(path);
  if (format == Format::png) return PngReader(path).read();
  if (format == Format::ppm) return read_ppm(path);
  throw unknown_format(path);
}

Image read_image(const fs::path& path) {
  const Samples samples = read_samples(path);
  const auto reduced = [](std::uint16_t sample) { return (sample * 255u + 32767u) / 65535u; };
  Image image{samples.width, samples.height, {}};
  image.pixels.reserve(samples.pixels.size());
  for (const auto& [r, g, b] : samples.pixels)
    image.pixels.push_back(rgb(reduced(r), reduced(g), reduced(b)));
  return image;
}

}  // namespace edgewise

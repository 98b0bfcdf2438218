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
#include "core/float_state.h"
#include "core/input_file.h"
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
    auto& stream = *static_cast<PngReader*>(png_get_io_ptr(png))->file_.stream;
    if (!stream.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count)))
      png_error(png, "truncated");
  }

  const fs::path& path_;
  InputFile file_;
  std::array<char, 128> message_{};
  png_structp png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  png_infop info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
};

std::runtime_error unknown_format(const fs::path& path) {
  return file_error(path, "is neither a .png nor a .ppm");
}

}  // namespace

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
  const DefaultFloatState state;
  netpbm::check_pixels(path, image.width, image.height, image.pixels.size());
  AtomicFile file(path);
  if (format == Format::png)
    write_png(file.stream(), path, image);
  else
    write_ppm(file.stream(), image);
  file.commit();
}

void write_pfm(const fs::path& path, const DepthMap& map) {
  const DefaultFloatState state;
  netpbm::check_pixels(path, map.width, map.height, map.depth01.size());
  AtomicFile file(path);
  write_pfm(file.stream(), map);
  file.commit();
}

DepthMap read_pfm(const fs::path& path) {
  return read_pfm(path, open_input(path));
}

Samples read_samples(const fs::path& path) {
  const DefaultFloatState state;
  const auto format = format_of_input(path);
  if (format == Format::png) return PngReader(path).read();
  if (format == Format::ppm) return read_ppm(path, open_input(path));
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

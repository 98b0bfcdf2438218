// PNGs are read through libpng's full interface: the simplified one, which writes them, converts colours.
#include "edgewise/image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "core/float_state.h"
#include "core/input_file.h"
#include "edgewise/scene.h"
#include "files/atomic_file.h"
#include "image/format.h"
#include "image/netpbm.h"

namespace edgewise {

namespace {

namespace fs = std::filesystem;

// Calls write(stream of the file).
template <typename AnyPicture, typename Write>
void write_whole(const fs::path& path, const AnyPicture& picture, std::size_t pixels, const Write& write) {
  const DefaultFloatState state;
  netpbm::check_pixels(path, picture.width, picture.height, pixels);
  AtomicFile file(path);
  write(file.stream());
  file.commit();
}

template <typename AnyPicture>
void write_png(std::ostream& out, const fs::path& path, const AnyPicture& picture, png_uint_32 format,
               const void* samples) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(picture.width);
  png.height = static_cast<png_uint_32>(picture.height);
  png.format = format;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  const auto encoded = std::make_unique_for_overwrite<char[]>(size);
  if (!png_image_write_to_memory(&png, encoded.get(), &size, 0, samples, 0, nullptr))
    throw FileError(path, png.message);
  out.write(encoded.get(), static_cast<std::streamsize>(size));
}

class PngReader {
 public:
  PngReader(const fs::path& path, InputFile file) : path_(path), file_(std::move(file)) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  Samples read(std::vector<std::string>* warnings) {
    if (info_ == nullptr) throw std::bad_alloc();
    run([&] {
      png_set_read_fn(png_, this, read_bytes);
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // checked_size() reports large ones
      png_read_info(png_, info_);
    });
    const netpbm::Size size =
        netpbm::checked_size(path_, png_get_image_width(png_, info_), png_get_image_height(png_, info_));
    Samples image{size.width,
                  size.height,
                  png_get_bit_depth(png_, info_) == 16,
                  (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0,
                  {}};
    image.pixels.resize(size.pixels());
    run([&] {
      png_set_expand_16(png_);
      png_set_gray_to_rgb(png_);
      png_set_add_alpha(png_, 65535, PNG_FILLER_AFTER);
      if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);  // a PNG is big-endian
      const int passes = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      for (int pass = 0; pass < passes; ++pass)
        for (std::size_t i = 0; i < size.pixels(); i += static_cast<std::size_t>(size.width))
          png_read_row(png_, reinterpret_cast<png_bytep>(&image.pixels[i]), nullptr);
    });
    try {
      run([&] { png_read_end(png_, nullptr); });
    } catch (const FileError&) {
      // Only if the checksum of the pixels was there.
      const bool in_pixels = (png_get_io_state(png_) & PNG_IO_CHUNK_HDR) == 0 &&
                             png_get_io_chunk_type(png_) == ('I' << 24 | 'D' << 16 | 'A' << 8 | 'T');
      if (!cut_ || in_pixels) throw;
      if (warnings != nullptr) warnings->push_back(path_.string() + ": ends after its pixels, without IEND");
    }
    return image;
  }

 private:
  // libpng reports an error by a jump to here, so the calls must not own anything.
  template <typename Calls>
  [[gnu::noinline]] void run(const Calls& calls) {
    if (setjmp(png_jmpbuf(png_)) != 0) throw FileError(path_, message_.data());
    calls();
  }
  static void fail(png_structp png, png_const_charp message) {
    auto& text = static_cast<PngReader*>(png_get_error_ptr(png))->message_;
    std::strncpy(text.data(), message, text.size() - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void read_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (reader.file_.stream->read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count)))
      return;
    reader.cut_ = true;
    png_error(png, "truncated");
  }

  const fs::path& path_;
  InputFile file_;
  bool cut_ = false;
  std::array<char, 128> message_{};
  png_structp png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  png_infop info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
};

}  // namespace

std::optional<Format> format_of(const fs::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".png") return Format::png;
  if (extension == ".ppm") return Format::ppm;
  if (extension == ".pfm") return Format::pfm;
  return {};
}

bool is_image_path(const fs::path& path) {
  const auto format = format_of(path);
  return format && *format != Format::pfm;
}

void write_image(const fs::path& path, const Image& image) {
  if (!is_image_path(path)) throw FileError(path, "is neither a .png nor a .ppm");
  write_image(path, image, *format_of(path));
}

void write_image(const fs::path& path, const Image& image, Format format) {
  write_whole(path, image, image.pixels.size(), [&](std::ostream& out) {
    if (format == Format::png)
      write_png(out, path, image, PNG_FORMAT_RGB, rgb_bytes(image).data());
    else
      write_ppm(out, image);
  });
}

void write_grey16(const fs::path& path, const Grey16& image) {
  if (format_of(path) != Format::png) throw FileError(path, "is not a .png, the only format for 16-bit grey");
  write_whole(path, image, image.pixels.size(), [&](std::ostream& out) {
    write_png(out, path, image, PNG_FORMAT_LINEAR_Y, image.pixels.data());
  });
}

void write_pfm(const fs::path& path, const DepthMap& map) {
  write_whole(path, map, map.depth01.size(), [&](std::ostream& out) { write_pfm(out, map); });
}

DepthMap read_pfm(const fs::path& path) {
  const DefaultFloatState state;
  FloatMap map = read_pfm(path, open_input(path));
  if (map.channels != 1) throw FileError(path, "has three channels; a depth map has one");
  return {map.width, map.height, std::move(map.values)};
}

Picture read_picture(const fs::path& path, std::vector<std::string>* warnings) {
  const DefaultFloatState state;
  InputFile file = open_input(path);
  if (starts_with(file, "\x89PNG")) return PngReader(path, std::move(file)).read(warnings);
  for (const char* magic : {"P2", "P3", "P5", "P6"})
    if (starts_with(file, magic)) return read_ppm(path, std::move(file));
  for (const char* magic : {"Pf", "PF"})
    if (starts_with(file, magic)) return read_pfm(path, std::move(file));
  throw FileError(path, "is neither a PNG, a PGM or PPM (P2, P3, P5, P6) nor a PFM");
}

Image to_image(const fs::path& path, const Picture& picture) {
  const DefaultFloatState state;
  if (const auto* const samples = std::get_if<Samples>(&picture)) {
    const auto reduced = [](std::uint16_t sample) { return (sample * 255u + 32767u) / 65535u; };
    Image image{samples->width, samples->height, {}};
    image.pixels.reserve(samples->pixels.size());
    for (const auto& [r, g, b, alpha] : samples->pixels)
      image.pixels.push_back(rgb(reduced(r), reduced(g), reduced(b)));
    return image;
  }
  const auto& map = std::get<FloatMap>(picture);
  if (map.channels != 3) throw FileError(path, "is a depth map, which read_pfm() reads");
  const auto reduced = [](float value) {  // NaN becomes 0
    return value > 0.0f ? static_cast<std::uint32_t>(std::min(value, 1.0f) * 255.0f + 0.5f) : 0u;
  };
  Image image{map.width, map.height, {}};
  image.pixels.reserve(map.values.size() / 3);
  for (auto v = map.values.begin(); v != map.values.end(); v += 3)
    image.pixels.push_back(rgb(reduced(v[0]), reduced(v[1]), reduced(v[2])));
  return image;
}

Samples to_samples(const Image& image) {
  Samples samples{image.width, image.height, false, false, {}};
  samples.pixels.reserve(image.pixels.size());
  for (const std::uint32_t pixel : image.pixels) {
    const auto sample = [pixel](int shift) {
      return static_cast<std::uint16_t>((pixel >> shift & 255) * 257);
    };
    samples.pixels.push_back({sample(0), sample(8), sample(16), sample(24)});
  }
  return samples;
}

Image read_image(const fs::path& path, std::vector<std::string>* warnings) {
  return to_image(path, read_picture(path, warnings));
}

Grey16 to_grey16(const Samples& grey) {
  Grey16 image{grey.width, grey.height, {}};
  image.pixels.reserve(grey.pixels.size());
  for (const Samples::Pixel& pixel : grey.pixels) image.pixels.push_back(pixel[0]);
  return image;
}

Grey16 read_grey16(const fs::path& path, std::vector<std::string>* warnings) {
  const Picture picture = read_picture(path, warnings);
  const auto* const samples = std::get_if<Samples>(&picture);
  if (samples == nullptr || !samples->grey) throw FileError(path, "is no picture of grey");
  return to_grey16(*samples);
}

}  // namespace edgewise

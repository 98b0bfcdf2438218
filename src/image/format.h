// The formats of pictures and depth files, and what they hold, for comparisons.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/input_file.h"
#include "edgewise/image.h"

namespace edgewise {

enum class Format { png, ppm, pfm };

// By the extension.
std::optional<Format> format_of(const std::filesystem::path& path);

// Writes a PNG or a PPM, whatever the name.
void write_image(const std::filesystem::path& path, const Image& image, Format format);

// R, G, B and alpha as stored: no colour conversion (gAMA, iCCP, sRGB, cHRM). Colours come from the palette.
// Grey is R = G = B. An 8-bit sample v is 257 v, so that it equals the 16-bit sample of the same value. Alpha
// is 65535 in files that have none; transparent colours (tRNS) have alpha 0.
struct Samples {
  using Pixel = std::array<std::uint16_t, 4>;
  int width = 0, height = 0;  // px
  bool deep = false;          // more than 8 bits in the file
  bool grey = false;          // by the file's format
  std::vector<Pixel> pixels;  // row by row, top first
};

struct FloatMap {
  int width = 0, height = 0;  // px
  int channels = 1;           // 1 or 3
  std::vector<float> values;  // row by row, top first; the channels of a pixel follow one another
};

// What a file holds, by its first bytes. Throws what read_image() throws.
using Picture = std::variant<Samples, FloatMap>;
Picture read_picture(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

// As read_image() and read_grey16() convert them. `path` is for messages.
Image to_image(const std::filesystem::path& path, const Picture& picture);
Grey16 to_grey16(const Samples& grey);
Samples to_samples(const Image& image);  // 8 bits, with alpha

// The formats that need no library and no file; `path` is for messages. Streams must have the classic locale.
void write_ppm(std::ostream& out, const Image& image);
void write_pfm(std::ostream& out, const DepthMap& map);
Samples read_ppm(const std::filesystem::path& path, InputFile file);
FloatMap read_pfm(const std::filesystem::path& path, InputFile file);

std::vector<unsigned char> rgb_bytes(const Image& image);

// As difference() of files; null: no mask.
Difference difference(const Picture& a, const Picture& b, const Picture* mask);

}  // namespace edgewise

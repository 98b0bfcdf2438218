// The formats of pictures and depth files, and the samples of pictures, for comparisons.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <vector>

#include "core/input_file.h"
#include "edgewise/image.h"

namespace edgewise {

enum class Format { png, ppm, pfm };

// By the extension.
std::optional<Format> format_of(const std::filesystem::path& path);

// By the extension, or of /dev/stdin and other descriptors by the first bytes.
std::optional<Format> format_of_input(const std::filesystem::path& path);

// Writes a PNG or a PPM, whatever the name.
void write_image(const std::filesystem::path& path, const Image& image, Format format);

// R, G and B as stored: no colour conversion (gAMA, iCCP, sRGB, cHRM), and alpha is ignored. Colours come
// from the palette. Grey is R = G = B. An 8-bit sample v is 257 v, so that it equals the 16-bit sample of the
// same value.
struct Samples {
  using Pixel = std::array<std::uint16_t, 3>;
  int width = 0, height = 0;  // px
  bool deep = false;          // more than 8 bits in the file
  std::vector<Pixel> pixels;  // row by row, top first
};

// Reads a PNG or a PPM. Throws what read_image throws.
Samples read_samples(const std::filesystem::path& path);

// The formats that need no library and no file; `path` is for messages.
void write_ppm(std::ostream& out, const Image& image);
void write_pfm(std::ostream& out, const DepthMap& map);
Samples read_ppm(const std::filesystem::path& path, InputFile file);
DepthMap read_pfm(const std::filesystem::path& path, InputFile file);

std::vector<unsigned char> rgb_bytes(const Image& image);

// As difference() of images. The largest difference is of 65535 if one of the pictures is deep, otherwise of
// 255.
Difference difference(const Samples& a, const Samples& b);

struct MaskedDifference {
  Difference outside;         // of the mask
  int scale;                  // the largest sample, 255 or 65535; 1 for depths
  std::uint64_t masked = 0;   // pixels of the mask that are not black
  std::uint64_t ignored = 0;  // of those, the pixels that differ
};
// Pixels count as equal where the mask is not black; null: no mask. Throws std::invalid_argument if sizes
// differ.
MaskedDifference difference(const Samples& a, Samples b, const Samples* mask);
MaskedDifference difference(const DepthMap& a, DepthMap b, const Samples* mask);

}  // namespace edgewise

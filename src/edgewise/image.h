// Pictures and depth maps on disk, and the difference of two.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "edgewise/framebuffer.h"

namespace edgewise {

// 8-bit RGB; colours are 0xAABBGGRR and alpha is ignored.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  // row by row, top first
};

struct DepthMap {
  int width = 0, height = 0;
  std::vector<float> depth01;  // row by row, top first; 1 is the background
};

Image to_image(const Framebuffer& frame);
DepthMap to_depth_map(const Framebuffer& frame);  // contract depth units → [0, 1]

// Writes .png or .ppm (P6), by the extension. A file appears under its final name only when it is whole. All
// of the functions below throw std::runtime_error, naming the file and the reason.
void write_image(const std::filesystem::path& path, const Image& image);
Image read_image(const std::filesystem::path& path);

// PFM ("Pf", little endian, rows bottom up on disk).
void write_pfm(const std::filesystem::path& path, const DepthMap& map);
DepthMap read_pfm(const std::filesystem::path& path);

// True for the extensions that write_image and read_image know.
bool is_image_path(const std::filesystem::path& path);

struct Difference {
  std::uint64_t count = 0;  // pixels that differ
  double largest = 0.0;     // largest difference of a channel (0 … 255) or of a depth
  int first_x = -1, first_y = -1;
  Image picture;  // grey where equal, red where not, brighter for a larger difference
};

// Both throw std::invalid_argument if the sizes differ.
Difference difference(const Image& a, const Image& b);
Difference difference(const DepthMap& a, const DepthMap& b);

// Each pixel becomes a square of `factor` pixels.
Image enlarge(const Image& image, int factor);

}  // namespace edgewise

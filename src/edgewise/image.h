// Pictures and depth maps on disk, and the difference of two. Part of edgewise::files. Everything here is a
// value or a function without state: any thread may call anything at any time.
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <filesystem>
#include <vector>

#include "edgewise/framebuffer.h"

namespace edgewise {

// 8-bit RGB; colours are 0xAABBGGRR and alpha is ignored.
struct Image {
  int width = 0, height = 0;          // px
  std::vector<std::uint32_t> pixels;  // row by row, top first
};

struct DepthMap {
  int width = 0, height = 0;   // px
  std::vector<float> depth01;  // row by row, top first; 0 is near, 1 far or background
};

// Copies of a frame; any view that can be drawn into will do.
Image to_image(const ConstFrameView& frame);
DepthMap to_depth_map(const ConstFrameView& frame);  // units of rule 6 → [0, 1]

// Both take .png and .ppm (P6), by the extension. A written file appears under its name only when it is
// whole. All four throw std::runtime_error, naming the file and the reason: it cannot be opened, read or
// written; it is malformed, truncated, or of another format; a side is outside 1 … contract::kMaxImageSide;
// there are not width x height pixels.
void write_image(const std::filesystem::path& path, const Image& image);
Image read_image(const std::filesystem::path& path);

// PFM ("Pf", rows bottom up on disk), written in little endian, read in either.
void write_pfm(const std::filesystem::path& path, const DepthMap& map);
DepthMap read_pfm(const std::filesystem::path& path);

// True for the extensions that write_image and read_image know.
bool is_image_path(const std::filesystem::path& path);

struct Difference {
  std::uint64_t count = 0;         // pixels that differ
  double largest = 0.0;            // largest difference of a channel (0 … 255) or of a depth
  int first_x = -1, first_y = -1;  // px; of the first in reading order, or -1
  Image picture;                   // grey where equal, red where not, brighter for a larger difference
};

// Both throw std::invalid_argument if the sizes differ.
Difference difference(const Image& a, const Image& b);
Difference difference(const DepthMap& a, const DepthMap& b);

// Each pixel becomes a square of `factor` pixels. Throws std::invalid_argument for a factor below 1 or a side
// beyond contract::kMaxImageSide.
Image enlarge(const Image& image, int factor);

}  // namespace edgewise

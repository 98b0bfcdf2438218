// Pictures and depth maps: reading, writing and comparing them. Part of edgewise::files. The types are plain
// values and the functions have no state, so any thread may call them at any time.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <filesystem>
#include <vector>

#include "edgewise/framebuffer.h"

#pragma GCC visibility push(default)
namespace edgewise {

// An 8-bit RGB picture. Pixels are 0xAABBGGRR; alpha is ignored.
struct Image {
  int width = 0, height = 0;          // px
  std::vector<std::uint32_t> pixels;  // row by row, top first
};

struct DepthMap {
  int width = 0, height = 0;   // px
  std::vector<float> depth01;  // row by row, top first; 0 is near, 1 is far or background
};

// Copies of a frame's payload or depth. A FrameView or a Framebuffer converts to ConstFrameView. to_image()
// throws std::invalid_argument if the frame has no payload plane.
Image to_image(const ConstFrameView& frame);
DepthMap to_depth_map(const ConstFrameView& frame);  // contract units (rule 6) → [0, 1]

// The next four functions throw std::runtime_error, with the file's name and the reason, if
// - the file cannot be opened, read or written,
// - it is malformed, truncated, too long or of another format,
// - a side is outside 1 … contract::kMaxImageSide,
// - the picture to write does not have width x height pixels.
// A written file appears under its name only when it is complete, unless it can only be written in place.

// PNG or PPM (P6), by the extension .png or .ppm. Samples are read as stored, without colour conversion;
// alpha is ignored, and 16-bit samples v become 255 v / 65535, rounded.
void write_image(const std::filesystem::path& path, const Image& image);
Image read_image(const std::filesystem::path& path);

// PFM ("Pf", rows bottom up on disk). Written in little endian, read in either byte order.
void write_pfm(const std::filesystem::path& path, const DepthMap& map);
DepthMap read_pfm(const std::filesystem::path& path);

// True if the extension is one that write_image and read_image accept.
bool is_image_path(const std::filesystem::path& path);

struct Difference {
  std::uint64_t count = 0;         // pixels that differ
  double largest = 0.0;            // the largest difference of a channel (0 … 255) or of a depth
  int first_x = -1, first_y = -1;  // px; the first pixel that differs, row by row from the top; -1: none
  Image picture;                   // grey where equal, red where not; brighter red for a larger difference
};

// Compares two pictures or depth maps. Throws std::invalid_argument if their sizes differ.
Difference difference(const Image& a, const Image& b);
Difference difference(const DepthMap& a, const DepthMap& b);

// Repeats each pixel as a square of factor x factor pixels. Throws std::invalid_argument if the factor is
// below 1 or a side of the result exceeds contract::kMaxImageSide.
Image enlarge(const Image& image, int factor);

}  // namespace edgewise
#pragma GCC visibility pop

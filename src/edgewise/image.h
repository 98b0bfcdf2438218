// Pictures and depth maps: reading, writing and comparing them. Part of edgewise::files. The types are plain
// values and the functions have no state, so any thread may call them at any time.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "edgewise/framebuffer.h"

#pragma GCC visibility push(default)
namespace edgewise {

// An 8-bit RGB picture. Pixels are 0xAABBGGRR. Files are written without alpha, and read as if it were 255;
// difference() counts where it differs.
struct Image {
  int width = 0, height = 0;          // px
  std::vector<std::uint32_t> pixels;  // row by row, top first
};

// A picture of 16-bit grey, such as depths in millimetres.
struct Grey16 {
  int width = 0, height = 0;          // px
  std::vector<std::uint16_t> pixels;  // row by row, top first
};

struct DepthMap {
  int width = 0, height = 0;   // px
  std::vector<float> depth01;  // row by row, top first; 0 is near, 1 is far or background
};

// Copies of a frame's payload or depth. A FrameView or a Framebuffer converts to ConstFrameView. to_image()
// throws std::invalid_argument if the frame has no payload plane.
Image to_image(const ConstFrameView& frame);
DepthMap to_depth_map(const ConstFrameView& frame);  // contract units (rule 6) → [0, 1]

// The functions below throw std::runtime_error, with the file's name and the reason, if
// - the file cannot be opened, read or written, or an older file cannot be replaced,
// - it is malformed, truncated, too long or of another format,
// - a side is outside 1 … contract::kMaxImageSide,
// - the picture to write does not have width x height pixels.
// A written file appears under its name only when it is complete. An older one keeps its permissions. A
// process that is killed may leave a ".edgewise.*.partial" behind. Of files to read, a named pipe is refused;
// a pipe that is named as a descriptor (/dev/stdin, /dev/fd/3) is read to its end. No format depends on a
// locale.

// PNG or PPM (P6), by the extension .png or .ppm.
void write_image(const std::filesystem::path& path, const Image& image);
// PNG with 16 bits, by the extension .png.
void write_grey16(const std::filesystem::path& path, const Grey16& image);

// The format is that of the file's content: PNG, PGM and PPM (P2, P3, P5, P6), or PFM with three channels
// (PF). Samples are read as stored, without colour conversion; alpha is ignored. 16-bit samples v become 255
// v / 65535, rounded, and those of a PFM 255 v, rounded, between 0 and 255. A PNG that
// ends after its pixels, without IEND, is read with a warning.
Image read_image(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);
// The same, if the file is grey and no PFM. 8-bit samples v become 257 v.
Grey16 read_grey16(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

// PFM ("Pf", rows bottom up on disk). Written in little endian, read in either byte order.
void write_pfm(const std::filesystem::path& path, const DepthMap& map);
DepthMap read_pfm(const std::filesystem::path& path);

// True if the extension is one that write_image() accepts.
bool is_image_path(const std::filesystem::path& path);

struct Difference {
  std::uint64_t count = 0;         // pixels that differ
  double largest = 0.0;            // the largest difference of a channel or of a depth; infinite if one is
  int scale = 255;                 // what `largest` is out of: 255; 65535 if a file has 16 bits; 1 for floats
  int first_x = -1, first_y = -1;  // px; the first pixel that differs, row by row from the top; -1: none
  std::uint64_t alpha_count = 0;   // pixels whose alpha differs, which `count` leaves out
  std::uint64_t masked = 0;        // pixels of the mask, which both counts leave out
  std::uint64_t masked_count = 0;  // pixels of the mask that differ
  Image picture;                   // grey where equal, red where not; brighter red for a larger difference
};

// Compares two pictures or depth maps. Throws std::invalid_argument if their sizes differ.
Difference difference(const Image& a, const Image& b);
Difference difference(const DepthMap& a, const DepthMap& b);

// Compares two files as `edgewise diff` does: pictures sample by sample, at their full depth, or PFMs as
// floats. Pixels count as equal where the mask, a picture, is not black; empty: no mask. Throws
// std::invalid_argument also for a picture and a PFM, and what read_image() throws.
Difference difference(const std::filesystem::path& a, const std::filesystem::path& b,
                      const std::filesystem::path& mask = {}, std::vector<std::string>* warnings = nullptr);

// Repeats each pixel as a square of factor x factor pixels. Throws std::invalid_argument if the factor is
// below 1 or a side of the result exceeds contract::kMaxImageSide.
Image enlarge(const Image& image, int factor);

}  // namespace edgewise
#pragma GCC visibility pop

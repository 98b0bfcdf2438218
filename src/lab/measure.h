// What is counted about a frame: differences, hits, covered pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/backend.h"

namespace edgewise::lab {

struct FrameDifference {
  std::uint64_t pixels = 0;  // pixels whose depth or payload differ
  int first_x = -1, first_y = -1;
};
// Both frames must have the same size.
FrameDifference compare(const Framebuffer& a, const Framebuffer& b);

// How many triangles a backend draws at each pixel, row by row. The triangles are drawn in groups whose
// members' bounding boxes don't meet, so that every hit shows; fine for grids, slow for scenes of deep
// overlap.
std::vector<std::uint32_t> count_hits(Backend& backend, std::span<const ScreenTriangle> triangles, int width,
                                      int height, const Execution& execution);

// Pixels covered, each as often as triangles cover it (the sum of the hit counts), by one exact division a
// row and edge. Divided by the image's pixels this is the overdraw.
std::uint64_t covered_pixels(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab

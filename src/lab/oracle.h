// The brute-force oracle: what the contract says, computed slowly and apart from every backend's code.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// Draws by exact 128-bit arithmetic, each triangle against each pixel that its bounding box touches. Shares
// no arithmetic with edgewise/contract.h. Cost: the pixels of all boxes, at most pixels times triangles;
// meant for images of some 100 px a side, or for small triangles.
void draw_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background);

// The same for edges, by the rule on top of raster/wireframe.cpp.
void draw_edge_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame,
                      std::uint32_t background);

}  // namespace edgewise::lab

// The brute-force oracle: draws the contract's picture slowly and without any backend's code.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// Tests each triangle at each pixel that its bounding box touches, in exact 128-bit arithmetic. Shares no
// arithmetic with edgewise/contract.h. Cost: the pixels of all boxes, at most pixels times triangles; meant
// for images of about 100 px per side, or for small triangles.
void draw_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background);

// The same for wireframes, by the rule stated at the top of raster/wireframe.cpp.
void draw_edge_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame,
                      std::uint32_t background);

}  // namespace edgewise::lab

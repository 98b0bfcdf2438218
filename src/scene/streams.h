// Synthetic triangle streams: each stresses one part of a rasterizer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/builtin.h"

namespace edgewise {

// A grid of jittered cells of about `cell_px`, two triangles each in random order, whose border vertices lie
// on the image's border: it covers every pixel exactly once.
TriangleStream jittered_grid(const SceneRequest& request, double cell_px, std::uint64_t seed);

// Axis-aligned squares on the pixel grid, two triangles each in random order: each pixel lies in one of 16,
// one of 32 and one of 64 px, at different depths.
TriangleStream aligned_squares(const SceneRequest& request, std::uint64_t seed);

// Throws std::invalid_argument unless the scale is positive and the scene has no more than 10^8 triangles.
void check_triangles(double triangles, double scale);

}  // namespace edgewise

// Synthetic triangle streams: each stresses one part of a rasterizer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/builtin.h"

namespace edgewise {

// A jittered grid of cells of about `cell_px` px, two triangles each, in random order. The grid's border lies
// on the image's border, so it covers every pixel exactly once.
TriangleStream jittered_grid(const SceneRequest& request, double cell_px, std::uint64_t seed);

// Axis-aligned squares on the pixel grid, two triangles each, in random order and at random depths. Squares
// of 16, of 32 and of 64 px each cover every pixel.
TriangleStream aligned_squares(const SceneRequest& request, std::uint64_t seed);

// Throws std::invalid_argument if the scale is not positive or the scene has more than 10^8 triangles.
void check_triangles(double triangles, double scale);

}  // namespace edgewise

// Synthetic triangle streams: each stresses one part of a rasterizer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/builtin.h"

namespace edgewise {

// A grid of jittered cells of about `cell_px`, two triangles each in random order, whose border vertices lie
// on the image's border: it covers every pixel exactly once.
TriangleStream jittered_grid(const SceneRequest& request, double cell_px, std::uint64_t seed);

}  // namespace edgewise

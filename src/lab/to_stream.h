// From screen triangles back to a stream that the front end turns into the same screen triangles.
#pragma once

#include <span>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// The snapped positions are exact as floats. Depths came from floats in [0, 1] and return to the same floats,
// or to neighbours that map to the same depth units.
TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab

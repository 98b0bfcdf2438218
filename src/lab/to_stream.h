// Converts screen triangles to a stream that the front end converts back to the same screen triangles.
#pragma once

#include <span>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// Floats represent snapped positions exactly. Depths that came from floats in [0, 1] become the same floats,
// or neighbours that map to the same depth units.
TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab

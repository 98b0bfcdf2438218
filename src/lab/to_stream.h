// Converts screen triangles to a stream. The front end converts it back to the same coverage and colours.
#pragma once

#include <span>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// Floats represent snapped positions exactly. Depths are rounded to floats in [0, 1], by at most 64 units.
// Those that came from such floats become the same depths again.
TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab

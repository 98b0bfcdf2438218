// Converts screen triangles to a stream. The front end converts it back to the same coverage and colours.
#pragma once

#include <span>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::lab {

// Positions are kept exactly: in float, or all in double if a float would round one. Depths are rounded to
// floats in [0, 1], by at most 64 units; those that came from such floats become the same depths again. In
// double, all do.
TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height);

}  // namespace edgewise::lab

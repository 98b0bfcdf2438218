// Converts screen triangles to a stream, which the front end converts back to the same coverage and colours,
// and streams in double to floats.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "edgewise/scene.h"
#include "edgewise/screen_triangle.h"
#include "lab/method.h"

namespace edgewise::lab {

// Positions are kept exactly: in float, or all in double if a float would round one. Depths are rounded to
// floats in [0, 1], by at most 64 units; those that came from such floats become the same depths again. In
// double, all do.
TriangleStream to_stream(std::span<const ScreenTriangle> triangles, int width, int height);

// With 8 subpixel bits, positions are exact: they have at most 24 bits that may not be 0.
std::vector<FloatTriangle> as_floats(std::span<const ScreenTriangle> triangles);

// A stream in double, rounded to floats; nothing for other drawables.
std::optional<Drawable> in_floats(const Drawable& drawable);

}  // namespace edgewise::lab

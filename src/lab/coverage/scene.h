// A picture's triangles as coverage methods take them.
#pragma once

#include <vector>

#include "edgewise/frontend.h"
#include "lab/coverage/coverage.h"

namespace edgewise::lab {

struct CoverageScene {
  Size size;
  std::vector<FloatTriangle> floats;
  std::vector<ScreenTriangle> snapped;

  CoverageInput input() const { return {floats, snapped}; }
  Window window() const { return {size.width, size.height}; }
};

// The front end's triangles before and after snapping. Culls by the exact sign of a triangle's area before
// snapping, so that all methods get the same triangles.
CoverageScene coverage_scene(const Drawable& drawable, FrontendOptions options);

}  // namespace edgewise::lab

// The camera's matrix.
#pragma once

#include <glm/glm.hpp>

#include "edgewise/scene.h"

namespace edgewise {

// World space → pixels and depth in [0, 1], all times w. Throws std::invalid_argument if a value of the
// camera is out of range.
glm::dmat4 screen_matrix(const Camera& camera, int width_px, int height_px);

}  // namespace edgewise

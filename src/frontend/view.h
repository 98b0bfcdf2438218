// The camera as a matrix.
#pragma once

#include <glm/glm.hpp>

#include "edgewise/scene.h"

namespace edgewise {

// World → pixels and depth in [0, 1], all times w. Throws std::invalid_argument for a camera out of range.
glm::dmat4 screen_matrix(const Camera& camera, int width_px, int height_px);

}  // namespace edgewise

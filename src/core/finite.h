// True if no coordinate is NaN or infinite.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {

inline bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace edgewise

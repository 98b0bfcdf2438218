// True if no coordinate is NaN or infinite.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {

template <typename T>
bool is_finite(const glm::tvec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace edgewise

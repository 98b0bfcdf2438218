// True if no coordinate or element is NaN or infinite.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace edgewise {

template <typename T>
bool is_finite(const glm::tvec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool is_finite(const glm::dmat4& m) {
  for (int i = 0; i < 4; ++i)
    if (!is_finite(glm::dvec3(m[i])) || !std::isfinite(m[i].w)) return false;
  return true;
}

}  // namespace edgewise

// The points that meshes are relative to (Mesh::origin).
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "edgewise/scene.h"

namespace edgewise {

inline Bounds no_box() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
}
inline void extend(Bounds& box, const glm::dvec3& point) {
  box.low = glm::min(box.low, point), box.high = glm::max(box.high, point);
}

// Whether a coordinate exceeds 4 times the longest side of a box. Rounding such coordinates to float would
// cost more than two bits of the mesh's shape.
bool is_far(const Bounds& box);

// The centre of a box, rounded to a multiple of the largest power of two that is at most the box's longest
// side: subtracting it leaves coordinates of about that length.
glm::dvec3 rounded_centre(const Bounds& box);

// Makes all origins 0 and moves the instances instead, for code that changes instances. The picture stays the
// same.
void fold_origins(Scene& scene);

}  // namespace edgewise

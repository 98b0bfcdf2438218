// Transforms vertices, tests them against the sides of the view, projects and snaps them. See
// transform.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// x and y in pixels times w, and w, of one vertex, with the same order of operations as every SIMD target.
inline glm::vec3 transform(const ScreenTransform& to_screen, glm::vec3 position) {
  const glm::mat4x3& m = to_screen.rounded;
  const glm::vec3 p = position - glm::vec3(to_screen.origin);
  const auto row = [&](int r) { return m[0][r] * p.x + m[1][r] * p.y + m[2][r] * p.z + m[3][r]; };
  return {row(0), row(1), row(2)};
}

inline ClipVertex as_clip_vertex(glm::vec3 transformed) {
  const glm::dvec3 v(transformed);
  return {v.x, v.y, v.z, v.z};
}

// Transforms `count` vertices. Returns the sides (flags of Outside) that all finite vertices lie beyond. The
// result has kNotFinite if no vertex is finite.
using TransformKernel = std::uint32_t (*)(const MeshTask& task, const glm::vec3* positions, std::size_t count,
                                          Vertex* out);

// `target` must be resolved.
TransformKernel transform_kernel(SimdTarget target);

}  // namespace edgewise

// Transforms each vertex once, tests it against the sides of the view, projects and snaps it. See
// transform.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// Transforms one vertex, with the same order of operations as every SIMD target.
inline ClipVertex transform(const glm::mat4& m, glm::vec3 p) {
  const auto row = [&](int r) { return m[0][r] * p.x + m[1][r] * p.y + m[2][r] * p.z + m[3][r]; };
  return {row(0), row(1), row(2), row(3)};
}

// Transforms vertices begin … end - 1. Returns the sides (flags of Outside) that all finite vertices lie
// beyond. The result has kNotFinite if no vertex is finite.
using TransformKernel = std::uint32_t (*)(const MeshTask& task, std::size_t begin, std::size_t end);

// `target` must be resolved.
TransformKernel transform_kernel(SimdTarget target);

}  // namespace edgewise

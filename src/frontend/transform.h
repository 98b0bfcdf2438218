// Every vertex once: transformed, judged against the sides of the view, projected and snapped. See
// transform.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// One vertex, in the order of operations that every SIMD target keeps.
inline ClipVertex transform(const glm::mat4& m, glm::vec3 p) {
  const auto row = [&](int r) { return m[0][r] * p.x + m[1][r] * p.y + m[2][r] * p.z + m[3][r]; };
  return {row(0), row(1), row(2), row(3)};
}

// Transforms vertices begin … end - 1 and returns the sides of Outside beyond which all finite ones lie;
// kNotFinite is among them if there is none.
using TransformKernel = std::uint32_t (*)(const MeshTask& job, std::size_t begin, std::size_t end);

// `target` must be resolved.
TransformKernel transform_kernel(SimdTarget target);

}  // namespace edgewise

// Flat shading of visible triangles. See shade.cpp.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

// Transforms normals as a model matrix transforms positions. Reverses them, like the winding, if it mirrors.
glm::dmat3 cofactor_matrix(const glm::dmat4& model);

struct ShadeTask {
  const Mesh& mesh;
  glm::dmat3 cofactor;     // of the model matrix
  glm::dvec3 to_light;     // normalised
  std::uint32_t first_id;  // of the mesh's triangles
};

// Replaces the triangles' ids by lit colours.
using ShadeKernel = void (*)(const ShadeTask& task, std::span<ScreenTriangle> triangles);

// `target` must be resolved.
ShadeKernel shade_kernel(SimdTarget target);

// The lit colours of a scene's triangles in submission order, including those that the front end would drop.
// All mesh and vertex indices must exist. Throws std::invalid_argument for a camera or matrices that
// Frontend::run() refuses.
std::vector<std::uint32_t> lit_colours(const Scene& scene);

}  // namespace edgewise

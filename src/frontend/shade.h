// Flat shading of visible triangles. See shade.cpp.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "edgewise/simd_target.h"
#include "frontend/tasks.h"

namespace edgewise {

struct ShadeJob {
  ShadeJob(const Mesh& mesh, const glm::dmat4& model, glm::dvec3 to_light);

  const Mesh& mesh;
  glm::dmat3 cofactor;
  glm::dvec3 to_light;  // normalised
};

// Replaces the payload of a run's triangles from `first` on, their index in the mesh, by their colour in the
// light.
using ShadeKernel = void (*)(const ShadeJob& job, RunOutput& run, std::size_t first);

// `target` must be resolved.
ShadeKernel shade_kernel(SimdTarget target);

// The colours that the front end gives to a scene's triangles, in the order of submission, those that it
// drops included. All indices must exist.
std::vector<std::uint32_t> lit_colours(const Scene& scene);

}  // namespace edgewise

// Polygons in space: into triangles, and from pairs of them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "edgewise/scene.h"

namespace edgewise {

// Appends polygon.size() - 2 triangles that fill the polygon and have its winding. The polygon may be concave
// and may have holes that a doubled edge connects to its outline. If it crosses itself or has no area, it is
// not necessarily filled. `polygon` holds at least three indices into `positions`, which must be finite.
// Subtracts the steps that this takes, of about 40 ns, from `steps_left`. Throws std::invalid_argument if
// more are needed; some triangles may then be appended.
void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles, std::uint64_t& steps_left);

// Joins triangles 0 and 1, 2 and 3, … of every mesh into faces with the colour of the first triangle. Each
// pair must be the halves p, q, s and q, r, s of a cell p, q, r, s, as in the built-in sphere and torus knot.
// The meshes must have no triangle flags.
void join_cells(Scene& scene);

}  // namespace edgewise

// Triangulates polygons in space.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace edgewise {

// Appends polygon.size() - 2 triangles that fill the polygon and have its winding. The polygon may be concave
// and may have holes that a doubled edge connects to its outline. If it crosses itself or has no area, it is
// not necessarily filled. `polygon` holds at least three indices into `positions`, which must be finite.
// Throws std::invalid_argument if the polygon has so many concave corners that it would take minutes.
void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles);

}  // namespace edgewise

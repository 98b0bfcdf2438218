// Polygons in space → triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace edgewise {

// Appends polygon.size() - 2 triangles that keep the polygon's winding and fill it, concave or not; holes may
// be bridged by a doubled edge. A polygon that crosses itself or has no area still gets its triangles, in
// some arrangement. All indices must lie in `positions`, which must be finite, and there must be at least
// three. Throws std::invalid_argument for a polygon of so many concave corners that it would take minutes.
void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<glm::uvec3>& triangles);

}  // namespace edgewise

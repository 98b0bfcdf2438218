// A transformed vertex: projected and snapped, with the sides of the view that it lies beyond. It has 16
// bytes, so triangle assembly loads it with one instruction.
#pragma once

#include <cmath>
#include <cstdint>

#include "frontend/clip.h"
#include "frontend/fixed.h"

namespace edgewise {

struct Vertex {
  std::int32_t x_sub, y_sub;  // sub-units; x_sub, y_sub and z are valid only if the vertex needs no clipping
  std::uint32_t z;            // contract units
  std::uint32_t outside;      // flags of Outside
};
static_assert(sizeof(Vertex) == 16);

// True if the division is safe: w > 0, and it cannot give NaN.
inline bool can_project(const ClipVertex& v) {
  return v.w > 0.0f && std::isfinite(1.0f / v.w) && std::isfinite(v.x) && std::isfinite(v.y) &&
         std::isfinite(v.z);
}

// Divides by w and snaps. Requires can_project(). z: contract units.
inline Vertex project(const ClipVertex& v, std::uint32_t z) {
  const float inverse_w = 1.0f / v.w;
  return {snap(v.x * inverse_w), snap(v.y * inverse_w), z, 0};
}

// A vertex that lies inside but cannot be projected gets kNear, so that its triangles go to the clipper.
inline Vertex make_vertex(const ClipVertex& v, std::uint32_t z, float width_px, float height_px) {
  const std::uint32_t outside = outside_of(v, width_px, height_px);
  if ((outside & (kMustClip | kNotFinite)) != 0) return {0, 0, 0, outside};
  if (!can_project(v)) return {0, 0, 0, outside | kNear};
  Vertex vertex = project(v, z);
  vertex.outside = outside;
  return vertex;
}

}  // namespace edgewise

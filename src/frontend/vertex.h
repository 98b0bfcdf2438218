// A vertex on its way to the screen: projected and snapped, with the sides of the view that it lies beyond.
// Sixteen bytes, so that assembly fetches one with one load.
#pragma once

#include <cmath>
#include <cstdint>

#include "frontend/clip.h"
#include "frontend/fixed.h"

namespace edgewise {

struct Vertex {
  std::int32_t x_sub, y_sub;  // these three are set where `outside` asks for no clipping
  std::uint32_t z;
  std::uint32_t outside;  // Outside
};
static_assert(sizeof(Vertex) == 16);

// Only then is the division safe: w > 0, and no NaN can come of it.
inline bool can_project(const ClipVertex& v) {
  return v.w > 0.0f && std::isfinite(1.0f / v.w) && std::isfinite(v.x) && std::isfinite(v.y) &&
         std::isfinite(v.z);
}

inline Vertex project(const ClipVertex& v) {
  const float inverse_w = 1.0f / v.w;
  return {snap(v.x * inverse_w), snap(v.y * inverse_w), quantize_depth(v.z * inverse_w), 0};
}

// What is inside but cannot be projected goes by kNear through the clipper, which judges its triangles.
inline Vertex make_vertex(const ClipVertex& v, float width_px, float height_px) {
  const std::uint32_t outside = outside_of(v, width_px, height_px);
  if ((outside & (kMustClip | kNotFinite)) != 0) return {0, 0, 0, outside};
  if (!can_project(v)) return {0, 0, 0, outside | kNear};
  Vertex vertex = project(v);
  vertex.outside = outside;
  return vertex;
}

}  // namespace edgewise

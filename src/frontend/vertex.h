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

inline float x_px(const ClipVertex& v) {
  return static_cast<float>(v.x / v.w);
}
inline float y_px(const ClipVertex& v) {
  return static_cast<float>(v.y / v.w);
}

// True if the division is safe: w > 0, and it cannot give NaN.
inline bool can_project(const ClipVertex& v) {
  return v.w > 0.0 && std::isfinite(x_px(v)) && std::isfinite(y_px(v));
}

// True if x_sub, y_sub and z are valid.
inline bool is_inside(const Vertex& v) {
  return (v.outside & (kMustClip | kNotFinite)) == 0;
}

}  // namespace edgewise

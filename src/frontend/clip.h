// Vertices, and clipping in homogeneous space (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "frontend/fixed.h"

namespace edgewise {

// A vertex in clip space with the viewport already applied: x / w and y / w are pixels. In a scene with a
// camera or a usual perspective projection, z is w, the distance along the view direction, so that no matrix
// rounds it twice. With any other matrices, z / w is the depth. A stream's z is its depth, and its w is 1.
struct ClipVertex {
  double x, y, z, w;
  // 0, 1 or 2: this corner of the triangle, which counts as inside all planes; a new vertex has none.
  int corner = -1;
  int id = 0;  // for Clipper::weights()
};

// The far plane is z = far_z + far_w w.
struct ViewVolume {
  double width_px, height_px, near_z, far_z, far_w = 0.0;
};

// The sides of the view that a vertex lies beyond, as flags. Every test is linear in the vertex. So if all
// vertices of a triangle lie beyond one side, the whole triangle does, whatever the signs of w.
enum Outside : std::uint16_t {
  kNear = 1,
  kFar = 2,
  kGuardLeft = 4,
  kGuardRight = 8,
  kGuardTop = 16,
  kGuardBottom = 32,
  kLeft = 64,
  kRight = 128,
  kTop = 256,
  kBottom = 512,
  kNotFinite = 1024,
  kGuard = kGuardLeft | kGuardRight | kGuardTop | kGuardBottom,
  kMustClip = kNear | kFar | kGuard,
  kInvisible = kNear | kFar | kLeft | kRight | kTop | kBottom,
};

// The flags of a vertex; kNotFinite alone if a coordinate is NaN or infinite.
std::uint16_t outside_of(const ClipVertex& v, const ViewVolume& view);

// Of the triangle's vertices in vertex `k`: 1 of itself.
inline std::array<double, 3> weights_of_corner(int k) {
  return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
}

// Clips triangles against the near, far and guard planes.
class Clipper {
 public:
  static constexpr std::size_t kMaxVertices = 3 + 6;  // each plane adds at most one vertex

  // Clips a triangle against the planes in `planes` (flags of Outside). Returns the polygon in the triangle's
  // order: empty, or of 3 … kMaxVertices vertices. It is valid until the next call. A new vertex is always
  // interpolated from the inside vertex to the outside one, so both triangles that share an edge get the same
  // bits.
  std::span<const ClipVertex> clip(const ClipVertex (&triangle)[3], std::uint16_t planes,
                                   const ViewVolume& view);
  // The weights of the triangle's vertices in one of the polygon, which add up to 1 (rule 11).
  std::array<double, 3> weights(const ClipVertex& v) const { return weights(v.id); }

 private:
  // Vertices 0, 1 and 2 are the triangle's. Vertex 3 + i lies on the edge that cut i names.
  struct Cut {
    int inside, outside;
    double t;  // from the inside vertex to the outside one
  };
  std::array<double, 3> weights(int id) const;

  std::array<ClipVertex, kMaxVertices> from_, to_;
  std::array<Cut, 2 * 6> cuts_;  // each plane cuts at most two edges
};

// A transformed vertex: projected and snapped, with the sides of the view that it lies beyond. It has 16
// bytes, so triangle assembly loads it with one instruction.
struct Vertex {
  std::int32_t x_q15, y_q15;  // 2^-15 px; x_q15, y_q15 and z are valid only if the vertex needs no clipping
  std::uint32_t z;            // contract units
  std::uint32_t outside;      // flags of Outside; kNotFinite stands alone
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

// True if x_q15, y_q15 and z are valid.
inline bool is_inside(const Vertex& v) {
  return (v.outside & (kMustClip | kNotFinite)) == 0;
}

struct Pieces {
  std::array<std::array<std::uint8_t, 3>, Clipper::kMaxVertices - 2> corners;  // indices into the polygon
  std::size_t count = 0;                                                       // the number of vertices - 2
};

// Splits a polygon of 3 … Clipper::kMaxVertices snapped vertices into triangles of one winding, which
// together cover each sample of the polygon once. The split is a fan about the first vertex if that has one
// winding.
//
// Snapping can bend a convex polygon slightly inwards, where a clipped edge lies close to a vertex or to
// another clipped edge. A fan may then contain a thin piece of the other winding. Its samples would be drawn
// twice. And culling, which tests each piece, would keep this piece of a triangle that faces the wrong way.
//
// Two edges within a few sub-units of each other may cross after snapping. Then no such split exists, and the
// result is the fan: it loses no sample, but may draw some twice.
Pieces split(std::span<const Vertex> polygon);

}  // namespace edgewise

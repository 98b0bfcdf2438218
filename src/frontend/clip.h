// Clipping in homogeneous space (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace edgewise {

// A vertex in clip space with the viewport already applied: x / w and y / w are pixels. The near and far
// planes are planes of constant z: a scene's z is w, the distance along the view direction, so that no matrix
// rounds it twice. A stream's z is its depth, and its w is 1.
struct ClipVertex {
  double x, y, z, w;
  // 0, 1 or 2: this corner of the triangle, which counts as inside all planes; a new vertex has none.
  int corner = -1;
};

struct ViewVolume {
  double width_px, height_px, near_z, far_z;
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

 private:
  std::array<ClipVertex, kMaxVertices> from_, to_;
};

}  // namespace edgewise

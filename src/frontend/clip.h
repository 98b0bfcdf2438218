// Clipping in homogeneous space (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace edgewise {

// A vertex before the division, with the viewport already applied: x / w and y / w are pixels, z / w is depth
// in [0, 1].
struct ClipVertex {
  float x, y, z, w;
};

// On which outer sides of the view a vertex lies; every test is linear in the vertex, so a triangle all of
// whose vertices share a side lies wholly beyond it, whatever the signs of w.
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

std::uint16_t outside_of(const ClipVertex& v, float width_px, float height_px);

// Clips a triangle against those of the near, far and guard planes that `planes` names, and returns the
// polygon: no vertex, or three to nine, in the triangle's order. A cut is always interpolated from the inside
// vertex to the outside one, so that both triangles at an edge get the bit-identical vertex.
class Clipper {
 public:
  static constexpr std::size_t kMaxVertices = 3 + 6;  // each plane adds at most one

  std::span<const ClipVertex> clip(const ClipVertex (&triangle)[3], std::uint16_t planes);

 private:
  std::array<ClipVertex, kMaxVertices> from_, to_;
};

}  // namespace edgewise

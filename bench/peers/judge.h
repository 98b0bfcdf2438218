// Is a peer's picture ours? Both are drawn with ids of triangles for payloads, over kNoTriangle.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::bench {

struct PeerJudgement {
  std::uint64_t drawn = 0;      // pixels that either drew
  std::uint64_t coverage = 0;   // drawn by one of the two only
  std::uint64_t near_ties = 0;  // another triangle won, but it covers the pixel and is as near up to rounding
  std::uint64_t owners = 0;     // another triangle won that must not
  int first_x = -1, first_y = -1;  // the first pixel that counts as `coverage` or `owners`

  std::uint64_t wrong() const { return coverage + owners; }
};

// By how much the depth that a peer computes for a triangle may be wrong, in contract depth units. It
// evaluates z = a + x dz/dx + y dz/dy in 24-bit floats. Where the triangle is thin its gradients, and with
// them every rounding of a product, grow by the square of its length over its area.
double float_plane_error(const ScreenTriangle& triangle, int width, int height);

// `triangles` are those that `ours` was drawn from, by ascending payload; `theirs` is as large.
PeerJudgement judge(const Framebuffer& ours, std::span<const std::uint32_t> theirs,
                    std::span<const ScreenTriangle> triangles);

}  // namespace edgewise::bench

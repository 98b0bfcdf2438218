// Compares a peer's picture with ours. Both are drawn with triangle ids as payloads, over kNoTriangle.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::bench {

struct PeerJudgement {
  // Numbers of pixels.
  std::uint64_t drawn = 0;            // in at least one of the pictures
  std::uint64_t coverage = 0;         // in exactly one
  std::uint64_t depth_ties = 0;       // another triangle, which covers the pixel at a depth within tolerance
  std::uint64_t other_triangles = 0;  // another triangle, not within tolerance
  int first_x = -1, first_y = -1;     // the first pixel in `coverage` or `other_triangles`

  std::uint64_t wrong() const { return coverage + other_triangles; }
};

// The bound on a peer's depth error for a triangle, in contract depth units. The peer evaluates
// z = a + x dz/dx + y dz/dy in floats of 24-bit significand. A thin triangle's gradients, and with them the
// rounding errors of the products, grow with the square of its length over its area.
double float_plane_error(const ScreenTriangle& triangle, int width, int height);

// `ours` was drawn from `triangles`, which are sorted by payload. `theirs` has the same size, row by row.
PeerJudgement judge(const Framebuffer& ours, std::span<const std::uint32_t> theirs,
                    std::span<const ScreenTriangle> triangles);

}  // namespace edgewise::bench

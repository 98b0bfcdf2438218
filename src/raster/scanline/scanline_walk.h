// One triangle's spans in one tile, by integers alone.
//
// Edges are walked by a digital differential analyser with remainder (Bresenham, "Algorithm for computer
// control of a digital plotter", 1965), so a row costs an addition and a comparison, and no division. This is
// the scalar form of the scanline kernel. The SIMD form uses it for the few triangles for which doubles are
// not precise enough.
#pragma once

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/tile_task.h"

namespace edgewise {

// The first pixel whose sample is not left of the edge from p down to q, row by row:
//   ceil(((p.x - 128) dy + (s - p.y) dx) / (256 dy)), where s is the height of the row's sample.
// This fits 64 bits: dy <= 2^23 and |dx| <= 2^23, so numerators stay below 2^48, and the denominator is at
// most 2^31.
class EdgeWalk {
 public:
  EdgeWalk() = default;
  EdgeWalk(std::int32_t px, std::int32_t py, std::int32_t qx, std::int32_t qy, int first_row) {
    using namespace contract;
    const std::int64_t dx = qx - px, dy = qy - py;
    denominator_ = dy * kSub;
    const std::int64_t numerator = (px - kHalf) * dy + (sample_sub(first_row) - py) * dx + denominator_ - 1;
    pixel_ = floor_div(numerator, denominator_);
    rest_ = numerator - pixel_ * denominator_;
    pixel_step_ = floor_div(dx, dy);
    rest_step_ = (dx - pixel_step_ * dy) * kSub;
  }
  std::int64_t pixel() const { return pixel_; }
  void next_row() {
    pixel_ += pixel_step_;
    rest_ += rest_step_;
    const std::int64_t carry = rest_ >= denominator_;  // no branch: it would be mispredicted
    rest_ -= denominator_ & -carry;
    pixel_ += carry;
  }

 private:
  static constexpr std::int64_t floor_div(std::int64_t n, std::int64_t d) {
    const std::int64_t q = n / d;
    return q * d > n ? q - 1 : q;
  }
  std::int64_t pixel_ = 0, rest_ = 0, denominator_ = 1, pixel_step_ = 0, rest_step_ = 0;
};

// Fills pixels [begin, end) of a row where they are nearer. Stores unconditionally, so that compilers
// vectorise it.
inline void fill_span(std::int32_t* depth, std::int32_t* payload, int begin, int end, std::uint32_t z,
                      std::uint32_t zx, std::uint32_t colour) {
  for (int x = begin; x < end; ++x) {
    const auto z_here = static_cast<std::int32_t>(z + static_cast<std::uint32_t>(x) * zx);
    const bool nearer = z_here < depth[x];
    depth[x] = nearer ? z_here : depth[x];
    payload[x] = nearer ? static_cast<std::int32_t>(colour) : payload[x];
  }
}

// Draws a triangle into a tile. `depth`, `payload`: the tile's buffers, in rows of kMaxTile pixels.
inline void walk_triangle(const TileTask& task, const ScreenTriangle& triangle, std::int32_t* depth,
                          std::int32_t* payload) {
  using namespace contract;
  const PixelBox box = pixel_box(triangle, task.frame.width, task.frame.height);
  const int first = std::max(box.y0, task.y0), last = std::min(box.y1, task.y0 + kMaxTile) - 1;
  if (first > last || std::max(box.x0, task.x0) >= std::min(box.x1, task.x0 + kMaxTile)) return;
  const Oriented t = orient(triangle);
  if (t.area == 0) return;

  // Clockwise on a y-down screen: an edge that goes up is on the left. Past its end, an edge's line continues
  // outside the triangle, so every row may use all edges.
  EdgeWalk left[2], right[2];
  int lefts = 0, rights = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (t.y[i] > t.y[j]) left[lefts++] = {t.x[j], t.y[j], t.x[i], t.y[i], first};
    if (t.y[i] < t.y[j]) right[rights++] = {t.x[i], t.y[i], t.x[j], t.y[j], first};
  }
  if (lefts == 1) left[1] = left[0];
  if (rights == 1) right[1] = right[0];

  const DepthPlane plane = make_depth(t);
  std::uint32_t z = plane.at(task.x0, first);  // the tile is one depth cell
  for (int y = first; y <= last; ++y, z += plane.zy) {
    const auto in_tile = [&](std::int64_t px) {
      return static_cast<int>(std::clamp<std::int64_t>(px - task.x0, 0, kMaxTile));
    };
    const int row = (y - task.y0) * kMaxTile;
    fill_span(depth + row, payload + row, in_tile(std::max(left[0].pixel(), left[1].pixel())),
              in_tile(std::min(right[0].pixel(), right[1].pixel())), z, plane.zx, triangle.payload);
    left[0].next_row(), left[1].next_row(), right[0].next_row(), right[1].next_row();
  }
}

}  // namespace edgewise

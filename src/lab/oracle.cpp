// Coverage by the rule itself, sample by sample: a sample strictly inside is covered; one on an edge is
// covered if the triangle lies below that edge (a top edge) or to the right of it (a left edge). Depth by the
// contract's formula in exact integers, with no shared code and no shortcut.
#include "lab/oracle.h"

#include <cstdlib>

#include "raster/contract.h"  // constants only

namespace edgewise::lab {

namespace {

__extension__ using Wide = __int128;

struct Point {
  Wide x, y;
};

Wide cross(Point o, Point a, Point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

Wide floor_divide(Wide n, Wide d) {
  Wide q = n / d, r = n % d;
  if (r != 0 && (r < 0) != (d < 0)) --q;
  return q;
}

class Exact {
 public:
  explicit Exact(const ScreenTriangle& t) {
    for (int i = 0; i < 3; ++i) {
      corner_[i] = {t.x_sub[i], t.y_sub[i]};
      z_[i] = t.z[i];
    }
    area_ = cross(corner_[0], corner_[1], corner_[2]);
    if (area_ == 0) return;
    // Gradients a pixel, with 16 fraction bits, rounded down.
    const Point &a = corner_[0], &b = corner_[1], &c = corner_[2];
    const Wide nx = (z_[1] - z_[0]) * (c.y - a.y) - (z_[2] - z_[0]) * (b.y - a.y);
    const Wide ny = (z_[2] - z_[0]) * (b.x - a.x) - (z_[1] - z_[0]) * (c.x - a.x);
    gx_ = floor_divide(nx * 256 * 65536, area_);
    gy_ = floor_divide(ny * 256 * 65536, area_);
    for (int i = 1; i < 3; ++i)
      if (corner_[i].y < corner_[top_].y ||
          (corner_[i].y == corner_[top_].y && corner_[i].x < corner_[top_].x))
        top_ = i;
  }

  bool covers(int px, int py) const {
    if (area_ == 0) return false;
    const Point s{Wide{px} * 256 + 128, Wide{py} * 256 + 128};
    for (int i = 0; i < 3; ++i) {
      const Point &from = corner_[i], &to = corner_[(i + 1) % 3], &third = corner_[(i + 2) % 3];
      const Wide side = cross(from, to, s);
      if (side == 0) {
        const bool top = from.y == to.y && third.y > from.y;
        if (!top && !(from.y != to.y && lies_right_of(third, from, to))) return false;
      } else if ((side > 0) != (area_ > 0)) {
        return false;
      }
    }
    return true;
  }

  std::uint32_t depth(int px, int py) const {
    const int cell_x = px / 64 * 64, cell_y = py / 64 * 64;
    const Wide dx = Wide{cell_x} * 256 + 128 - corner_[top_].x,
               dy = Wide{cell_y} * 256 + 128 - corner_[top_].y;
    // z has 24 fraction bits here: 16 of the gradients and 8 of the sub-units.
    const Wide base = floor_divide(z_[top_] * (1 << 24) + gx_ * dx + gy_ * dy + (1 << 23), 1 << 24);
    const Wide step_x = floor_divide(gx_ + 32768, 65536), step_y = floor_divide(gy_ + 32768, 65536);
    return static_cast<std::uint32_t>(base + step_x * (px - cell_x) + step_y * (py - cell_y));
  }

 private:
  // Whether `p` is to the right of a line that is not horizontal: compare x at p's height, signs cleared.
  static bool lies_right_of(Point p, Point from, Point to) {
    if (from.y > to.y) return lies_right_of(p, to, from);
    return (p.x - from.x) * (to.y - from.y) > (to.x - from.x) * (p.y - from.y);
  }

  Point corner_[3];
  Wide z_[3];
  Wide area_ = 0, gx_ = 0, gy_ = 0;
  int top_ = 0;
};

}  // namespace

void draw_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background) {
  const FrameView view = frame.view();
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      view.depth[y * view.stride + x] = contract::kDepthClear;
      view.payload[y * view.stride + x] = background;
    }
  for (const auto& triangle : triangles) {
    const Exact exact(triangle);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        if (!exact.covers(x, y)) continue;
        const std::uint32_t z = exact.depth(x, y);
        std::uint32_t& old = view.depth[y * view.stride + x];
        if (z >= old) continue;
        old = z;
        view.payload[y * view.stride + x] = triangle.payload;
      }
  }
}

}  // namespace edgewise::lab

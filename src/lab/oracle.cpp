// Coverage by the snapped truth, sample by sample, wherever a pixel touches the triangle's box. Depth by the
// contract's formula in exact integers, with no shared code and no shortcut.
#include "lab/oracle.h"

#include <algorithm>

#include "edgewise/contract.h"  // constants only
#include "lab/truth.h"

namespace edgewise::lab {

namespace {

__extension__ using Wide = __int128;

Wide floor_divide(Wide n, Wide d) {
  Wide q = n / d, r = n % d;
  if (r != 0 && (r < 0) != (d < 0)) --q;
  return q;
}

// Needs area.
class ContractDepth {
 public:
  explicit ContractDepth(const ScreenTriangle& t) {
    for (int i = 0; i < 3; ++i) x_[i] = t.x_sub[i], y_[i] = t.y_sub[i], z_[i] = t.z[i];
    const Wide area = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (y_[1] - y_[0]) * (x_[2] - x_[0]);
    // Gradients a pixel, with 16 fraction bits, rounded down.
    const Wide nx = (z_[1] - z_[0]) * (y_[2] - y_[0]) - (z_[2] - z_[0]) * (y_[1] - y_[0]);
    const Wide ny = (z_[2] - z_[0]) * (x_[1] - x_[0]) - (z_[1] - z_[0]) * (x_[2] - x_[0]);
    gx_ = floor_divide(nx * 256 * 65536, area);
    gy_ = floor_divide(ny * 256 * 65536, area);
    for (int i = 1; i < 3; ++i)
      if (y_[i] < y_[top_] || (y_[i] == y_[top_] && x_[i] < x_[top_])) top_ = i;
  }

  std::uint32_t at(int px, int py) const {
    const int cell_x = px / 64 * 64, cell_y = py / 64 * 64;
    const Wide dx = Wide{cell_x} * 256 + 128 - x_[top_], dy = Wide{cell_y} * 256 + 128 - y_[top_];
    // z has 24 fraction bits here: 16 of the gradients and 8 of the sub-units.
    const Wide base = floor_divide(z_[top_] * (1 << 24) + gx_ * dx + gy_ * dy + (1 << 23), 1 << 24);
    const Wide step_x = floor_divide(gx_ + 32768, 65536), step_y = floor_divide(gy_ + 32768, 65536);
    return static_cast<std::uint32_t>(base + step_x * (px - cell_x) + step_y * (py - cell_y));
  }

 private:
  Wide x_[3], y_[3], z_[3];
  Wide gx_ = 0, gy_ = 0;
  int top_ = 0;
};

// The pixels of an image, of `size` on an axis, whose squares touch [low, high] there; both ends included. A
// sample elsewhere lies outside the triangle.
struct PixelRange {
  int first, last;
};
PixelRange touched(const std::int32_t (&sub)[3], int size) {
  const auto [low, high] = std::minmax({sub[0], sub[1], sub[2]});
  return {static_cast<int>(std::max<Wide>(floor_divide(low, 256), 0)),
          static_cast<int>(std::min<Wide>(floor_divide(high, 256), size - 1))};
}

}  // namespace

void draw_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background) {
  const FrameView view = frame.view();
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      view.depth[y * view.stride + x] = contract::kDepthClear;
      view.payload[y * view.stride + x] = background;
    }
  for (const auto& triangle : triangles) {
    const SnappedTruth truth(triangle);
    if (truth.facing() == 0) continue;
    const ContractDepth depth(triangle);
    const PixelRange columns = touched(triangle.x_sub, view.width),
                     rows = touched(triangle.y_sub, view.height);
    for (int y = rows.first; y <= rows.last; ++y)
      for (int x = columns.first; x <= columns.last; ++x) {
        if (!truth.covers(x, y)) continue;
        const std::uint32_t z = depth.at(x, y);
        std::uint32_t& old = view.depth[y * view.stride + x];
        if (z >= old) continue;
        old = z;
        view.payload[y * view.stride + x] = triangle.payload;
      }
  }
}

}  // namespace edgewise::lab

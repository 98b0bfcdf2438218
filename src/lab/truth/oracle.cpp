// Coverage: the snapped truth at every sample whose pixel touches the triangle's box. Depth: the contract's
// formula in exact integers, with no shared code and no shortcut. Wireframe: the definition of its rule, at
// every pixel.
#include "lab/truth/oracle.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "edgewise/contract.h"  // constants only
#include "lab/truth/truth.h"

namespace edgewise::lab {

namespace {

__extension__ using Wide = __int128;

Wide floor_divide(Wide n, Wide d) {
  Wide q = n / d, r = n % d;
  if (r != 0 && (r < 0) != (d < 0)) --q;
  return q;
}

constexpr Wide kPixel = 32768;
Wide sample_q15(int px) {
  return kPixel * px + kPixel / 2;
}
Wide pixel_of(std::int32_t q15) {
  return floor_divide(q15, kPixel);
}

// The triangle must have area.
class ContractDepth {
 public:
  explicit ContractDepth(const ScreenTriangle& t) {
    for (int i = 0; i < 3; ++i) x_[i] = t.x_q15[i], y_[i] = t.y_q15[i], z_[i] = t.z[i];
    const Wide area = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (y_[1] - y_[0]) * (x_[2] - x_[0]);
    // Gradients per pixel, with 16 fraction bits, rounded down.
    const Wide nx = (z_[1] - z_[0]) * (y_[2] - y_[0]) - (z_[2] - z_[0]) * (y_[1] - y_[0]);
    const Wide ny = (z_[2] - z_[0]) * (x_[1] - x_[0]) - (z_[1] - z_[0]) * (x_[2] - x_[0]);
    gx_ = floor_divide(nx * 32768 * 65536, area);
    gy_ = floor_divide(ny * 32768 * 65536, area);
    for (int i = 1; i < 3; ++i)
      if (y_[i] < y_[top_] || (y_[i] == y_[top_] && x_[i] < x_[top_])) top_ = i;
  }

  std::uint32_t at(int px, int py) const {
    const int middle_x = px / 64 * 64 + 32, middle_y = py / 64 * 64 + 32;
    const Wide dx = sample_q15(middle_x) - x_[top_], dy = sample_q15(middle_y) - y_[top_];
    // z has 31 fraction bits here: 16 of the gradients and 15 of the positions.
    constexpr Wide kOne = std::int64_t{1} << 31;
    const Wide middle = floor_divide(z_[top_] * kOne + gx_ * dx + gy_ * dy + kOne / 2, kOne);
    const Wide step_x = floor_divide(gx_ + 32768, 65536), step_y = floor_divide(gy_ + 32768, 65536);
    return static_cast<std::uint32_t>(middle + step_x * (px - middle_x) + step_y * (py - middle_y));
  }

 private:
  Wide x_[3], y_[3], z_[3];
  Wide gx_ = 0, gy_ = 0;
  int top_ = 0;
};

// The candidate pixels on one axis of an image of `size` pixels: those whose squares touch the triangle's
// extent; both ends included. All other samples lie outside the triangle.
struct PixelRange {
  int first, last;
};
PixelRange candidates(const std::int32_t (&q15)[3], int size) {
  const auto [low, high] = std::minmax({q15[0], q15[1], q15[2]});
  return {static_cast<int>(std::max<Wide>(pixel_of(low), 0)),
          static_cast<int>(std::min<Wide>(pixel_of(high), size - 1))};
}

// depth_of(triangle) returns a function (x, y) → the depth, or nullopt where the triangle draws nothing.
template <typename DepthOf>
void draw(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background,
          DepthOf&& depth_of) {
  const FrameView view = frame.view();
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      view.depth[y * view.stride + x] = contract::kDepthClear;
      view.payload[y * view.stride + x] = background;
    }
  for (const auto& triangle : triangles) {
    if (SnappedTruth(triangle).facing() == 0) continue;
    const auto depth_at = depth_of(triangle);
    const PixelRange columns = candidates(triangle.x_q15, view.width),
                     rows = candidates(triangle.y_q15, view.height);
    for (int y = rows.first; y <= rows.last; ++y)
      for (int x = columns.first; x <= columns.last; ++x) {
        const std::optional<std::uint32_t> z = depth_at(x, y);
        std::uint32_t& old = view.depth[y * view.stride + x];
        if (!z || *z >= old) continue;
        old = *z;
        view.payload[y * view.stride + x] = triangle.payload;
      }
  }
}

// The depth of the edge between vertices i and j at a pixel, if it draws that pixel. edge_depth() adds the
// pixels that contain the vertices.
std::optional<Wide> depth_between(const ScreenTriangle& t, int i, int j, int px, int py) {
  Wide u[2] = {t.x_q15[i], t.x_q15[j]}, v[2] = {t.y_q15[i], t.y_q15[j]}, z[2] = {t.z[i], t.z[j]};
  const auto length = [](const Wide(&at)[2]) { return at[0] < at[1] ? at[1] - at[0] : at[0] - at[1]; };
  const bool along_x = length(u) >= length(v);
  if (!along_x) std::swap(u, v);
  if (u[0] > u[1]) std::swap(u[0], u[1]), std::swap(v[0], v[1]), std::swap(z[0], z[1]);
  const Wide sample = sample_q15(along_x ? px : py), du = u[1] - u[0], done = sample - u[0];
  if (sample < u[0] || sample >= u[1]) return {};
  if (floor_divide(v[0] * du + (v[1] - v[0]) * done, kPixel * du) != (along_x ? py : px)) return {};
  return floor_divide(2 * (z[0] * du + (z[1] - z[0]) * done) + du, 2 * du);
}

std::optional<std::uint32_t> edge_depth(const ScreenTriangle& t, int px, int py) {
  std::optional<Wide> nearest;
  const auto take = [&](std::optional<Wide> z) {
    if (z && (!nearest || *z < *nearest)) nearest = z;
  };
  for (int i = 0; i < 3; ++i) {
    take(depth_between(t, i, (i + 1) % 3, px, py));
    if (pixel_of(t.x_q15[i]) == px && pixel_of(t.y_q15[i]) == py) take(Wide{t.z[i]});
  }
  if (!nearest) return {};
  return static_cast<std::uint32_t>(*nearest);
}

}  // namespace

void draw_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame, std::uint32_t background) {
  draw(triangles, frame, background, [](const ScreenTriangle& triangle) {
    return [truth = SnappedTruth(triangle), depth = ContractDepth(triangle)](int x, int y) {
      return truth.covers(x, y) ? std::optional(depth.at(x, y)) : std::nullopt;
    };
  });
}

void draw_edge_oracle(std::span<const ScreenTriangle> triangles, Framebuffer& frame,
                      std::uint32_t background) {
  draw(triangles, frame, background, [](const ScreenTriangle& triangle) {
    return [&triangle](int x, int y) { return edge_depth(triangle, x, y); };
  });
}

}  // namespace edgewise::lab

// Fixed-point edge functions, stepped exactly by integer additions. SnapBits is the number of subpixel bits,
// Int the type of edge values: 64 bits hold them for triangles of up to 16384 px, 32 bits overflow early and
// wrap.
//
// While no value wraps, it is the exact edge function minus the bias, which is linear along a row: each edge
// accepts the samples on one side of a crossing, so a row's accepted samples are one interval. A value at a
// sample is twice the signed area of a triangle inside the bounding box, so none wraps if the box's area, in
// square units, is below 2^31 or 2^63. In larger boxes values may change sign anywhere, so every pixel is
// tested.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "lab/coverage/plot.h"

namespace edgewise::lab {

template <typename Int>
struct FixedEdge {
  using Wrapping = std::make_unsigned_t<Int>;
  Wrapping value, step_x, step_y;  // value at the box's first sample, biased by the fill rule
  int x0, y0;                      // the box's first pixel
  bool right;                      // whether the triangle lies to the right

  struct Row {
    Wrapping value, step;
    int x0;
    bool accepts(int x) const { return static_cast<Int>(value + step * static_cast<Wrapping>(x - x0)) >= 0; }
  };
  Row row(int y) const { return {value + step_y * static_cast<Wrapping>(y - y0), step_x, x0}; }
  bool faces_right() const { return right; }
};

struct FixedBox {
  PixelBounds pixels;
  double area;  // of the triangle's whole box, in square units of 2^-bits px
  int bits;

  // Whether no value, minus the bias, wraps.
  template <typename Int>
  bool holds() const {
    return area < static_cast<double>(std::uint64_t{1} << std::numeric_limits<Int>::digits);
  }
};

template <typename Int, class Plot>
void test_every_pixel(const FixedEdge<Int> (&e)[3], const PixelBounds& box, Plot& plot) {
  auto row0 = e[0].value, row1 = e[1].value, row2 = e[2].value;
  for (int py = box.y0; py < box.y1; ++py) {
    auto v0 = row0, v1 = row1, v2 = row2;
    for (int px = box.x0; px < box.x1; ++px) {
      if (static_cast<Int>(v0 | v1 | v2) >= 0) plot.pixel(px, py);
      v0 += e[0].step_x, v1 += e[1].step_x, v2 += e[2].step_x;
    }
    row0 += e[0].step_y, row1 += e[1].step_y, row2 += e[2].step_y;
  }
}

// Testing every pixel, at one addition per edge, is faster for boxes up to this width.
inline constexpr int kNarrowForIntegers_px = 10;

// edges-inl.h has the overload for plots in lanes.
template <typename Int, class Plot>
void fill(const FixedEdge<Int> (&edges)[3], const FixedBox& box, Plot& plot) {
  if (box.pixels.x1 - box.pixels.x0 > kNarrowForIntegers_px && box.holds<Int>())
    fill_between(edges, box.pixels, plot);
  else
    test_every_pixel(edges, box.pixels, plot);
}

template <int SnapBits, typename Int>
struct FixedEdges {
  // Samples lie at half a pixel, so one bit is needed even if vertices have none.
  static constexpr int kBits = SnapBits == 0 ? 1 : SnapBits;
  static constexpr std::int64_t kOne = std::int64_t{1} << kBits, kSample = kOne / 2;
  using Edge = FixedEdge<Int>;
  using Wrapping = typename Edge::Wrapping;

  static std::int64_t snap(float px) {
    return round_half_even(double{px} * (1 << SnapBits)) * (1 << (kBits - SnapBits));
  }

  static Edge edge(std::int64_t px, std::int64_t py, std::int64_t qx, std::int64_t qy, int x0, int y0) {
    const std::int64_t sx = x0 * kOne + kSample, sy = y0 * kOne + kSample;
    const std::int64_t a = py - qy, b = qx - px;
    const bool top_left = a > 0 || (a == 0 && b > 0);
    const auto wrap = [](std::int64_t v) { return static_cast<Wrapping>(v); };
    return {wrap(a) * wrap(sx - px) + wrap(b) * wrap(sy - py) - wrap(top_left ? 0 : 1),
            wrap(a) * wrap(kOne),
            wrap(b) * wrap(kOne),
            x0,
            y0,
            a >= 0};
  }

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    std::int64_t x[3], y[3];
    for (int i = 0; i < 3; ++i) x[i] = snap(t.x_px[i]), y[i] = snap(t.y_px[i]);
    const auto first = [](std::int64_t v) { return (v + kSample - 1) >> kBits; };  // sample at or after v
    const auto [min_x, max_x] = std::minmax({x[0], x[1], x[2]});
    const auto [min_y, max_y] = std::minmax({y[0], y[1], y[2]});
    const PixelBounds box{static_cast<int>(std::max<std::int64_t>(first(min_x), w.x0)),
                          static_cast<int>(std::max<std::int64_t>(first(min_y), w.y0)),
                          static_cast<int>(std::min<std::int64_t>(first(max_x), w.x1())),
                          static_cast<int>(std::min<std::int64_t>(first(max_y), w.y1()))};
    if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
    const auto area =
        static_cast<Int>(static_cast<Wrapping>(x[1] - x[0]) * static_cast<Wrapping>(y[2] - y[0]) -
                         static_cast<Wrapping>(y[1] - y[0]) * static_cast<Wrapping>(x[2] - x[0]));
    if (area == 0) return;
    if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
    plot.begin();
    const Edge edges[3] = {edge(x[0], y[0], x[1], y[1], box.x0, box.y0),
                           edge(x[1], y[1], x[2], y[2], box.x0, box.y0),
                           edge(x[2], y[2], x[0], y[0], box.x0, box.y0)};
    fill(edges, FixedBox{box, static_cast<double>(max_x - min_x) * static_cast<double>(max_y - min_y), kBits},
         plot);
  }
};

// Snapping moves a vertex by up to half a unit on each axis: sqrt(1/2) units. No point of a triangle moves
// farther than a vertex.
constexpr double snap_reach_px(int snap_bits) {
  return 0.70711 / (1 << snap_bits);
}

}  // namespace edgewise::lab

// Fixed-point edge functions, stepped exactly by integer additions. SnapBits say how finely vertices are
// snapped, Int how wide the edge values are: 64 bits hold them for triangles of up to 16384 px, 32 bits soon
// wrap.
#pragma once

#include <cstdint>
#include <type_traits>

#include "lab/coverage_plot.h"

namespace edgewise::lab {

template <int SnapBits, typename Int>
struct FixedEdges {
  // A sample lies at half a pixel, so one bit is needed even where vertices have none.
  static constexpr int kBits = SnapBits == 0 ? 1 : SnapBits;
  static constexpr std::int64_t kOne = std::int64_t{1} << kBits, kSample = kOne / 2;
  using Wrapping = std::make_unsigned_t<Int>;

  static std::int64_t snap(float px) {
    return round_half_even(double{px} * (1 << SnapBits)) * (1 << (kBits - SnapBits));
  }

  struct Edge {
    Wrapping value, step_x, step_y;  // value at the first sample, biased by the fill rule
  };
  static Edge edge(std::int64_t px, std::int64_t py, std::int64_t qx, std::int64_t qy, std::int64_t sx,
                   std::int64_t sy) {
    const std::int64_t a = py - qy, b = qx - px;
    const bool top_left = a > 0 || (a == 0 && b > 0);
    const auto wrap = [](std::int64_t v) { return static_cast<Wrapping>(v); };
    return {wrap(a) * wrap(sx - px) + wrap(b) * wrap(sy - py) - wrap(top_left ? 0 : 1), wrap(a) * wrap(kOne),
            wrap(b) * wrap(kOne)};
  }

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    std::int64_t x[3], y[3];
    for (int i = 0; i < 3; ++i) x[i] = snap(t.x_px[i]), y[i] = snap(t.y_px[i]);
    const auto first = [](std::int64_t v) { return (v + kSample - 1) >> kBits; };  // sample at or after v
    const auto [min_x, max_x] = std::minmax({x[0], x[1], x[2]});
    const auto [min_y, max_y] = std::minmax({y[0], y[1], y[2]});
    const int x0 = static_cast<int>(std::max<std::int64_t>(first(min_x), w.x0)),
              x1 = static_cast<int>(std::min<std::int64_t>(first(max_x), w.x1())),
              y0 = static_cast<int>(std::max<std::int64_t>(first(min_y), w.y0)),
              y1 = static_cast<int>(std::min<std::int64_t>(first(max_y), w.y1()));
    if (x0 >= x1 || y0 >= y1) return;
    const auto area =
        static_cast<Int>(static_cast<Wrapping>(x[1] - x[0]) * static_cast<Wrapping>(y[2] - y[0]) -
                         static_cast<Wrapping>(y[1] - y[0]) * static_cast<Wrapping>(x[2] - x[0]));
    if (area == 0) return;
    if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
    plot.begin();
    const std::int64_t sx = x0 * kOne + kSample, sy = y0 * kOne + kSample;
    const Edge e0 = edge(x[0], y[0], x[1], y[1], sx, sy), e1 = edge(x[1], y[1], x[2], y[2], sx, sy),
               e2 = edge(x[2], y[2], x[0], y[0], sx, sy);
    Wrapping row0 = e0.value, row1 = e1.value, row2 = e2.value;
    for (int py = y0; py < y1; ++py) {
      Wrapping v0 = row0, v1 = row1, v2 = row2;
      for (int px = x0; px < x1; ++px) {
        if (static_cast<Int>(v0 | v1 | v2) >= 0) plot.pixel(px, py);
        v0 += e0.step_x, v1 += e1.step_x, v2 += e2.step_x;
      }
      row0 += e0.step_y, row1 += e1.step_y, row2 += e2.step_y;
    }
  }
};

// Snapping moves a vertex by up to half a unit on both axes, and no point of a triangle moves farther than a
// vertex.
constexpr double snap_reach_px(int snap_bits) {
  return 0.70711 / (1 << snap_bits);
}

template <int SnapBits>
CoverageMethod make_fixed_method(const MethodInfo& info) {
  return make_coverage_method<FixedEdges<SnapBits, std::int64_t>>(
      info, {.reach_px = snap_reach_px(SnapBits), .no_gaps = true, .no_double_hits = true});
}

}  // namespace edgewise::lab

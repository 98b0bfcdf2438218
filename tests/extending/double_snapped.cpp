// A coverage method: snaps vertices to 1/64 px, then computes in doubles, which hold every product exactly.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/coverage/plot.h"

namespace edgewise::lab {

namespace {

struct DoubleSnapped {
  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window window, Plot& plot) {
    double x[3], y[3];  // px
    for (int i = 0; i < 3; ++i)
      x[i] = std::nearbyint(t.x_px[i] * 64.0) / 64.0, y[i] = std::nearbyint(t.y_px[i] * 64.0) / 64.0;
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (area == 0) return;
    if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
    const auto [left, right] = std::minmax({x[0], x[1], x[2]});
    const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
    const auto pixel = [](double px) { return static_cast<int>(std::floor(px)); };
    plot.begin();
    for (int row = std::max(pixel(top), window.y0); row < std::min(pixel(bottom) + 1, window.y1()); ++row)
      for (int column = std::max(pixel(left), window.x0); column < std::min(pixel(right) + 1, window.x1());
           ++column) {
        bool inside = true;
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3;
          const double a = y[i] - y[j], b = x[j] - x[i];
          const double edge = a * (column + 0.5 - x[i]) + b * (row + 0.5 - y[i]);
          inside &= edge > 0 || (edge == 0 && (a > 0 || (a == 0 && b > 0)));  // rule 4
        }
        if (inside) plot.pixel(column, row);
      }
  }
};

}  // namespace

CoverageMethod make_coverage_double_snapped();
CoverageMethod make_coverage_double_snapped() {
  return make_coverage_method<DoubleSnapped>(
      {.name = "double_snapped",
       .summary = "vertices snapped to 1/64 px, edge functions in doubles",
       .source = "tests/extending",
       .promise = "wrong only within 0.0111 px of an edge; watertight",
       .exact = false},
      {.reach_px = std::sqrt(0.5) / 64.0, .no_gaps = true, .no_double_hits = true, .snap_bits = 6});
}

}  // namespace edgewise::lab

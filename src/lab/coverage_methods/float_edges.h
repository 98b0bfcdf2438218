// Edge functions evaluated anew at each pixel of the bounding box, in floats or doubles (Pineda, "A Parallel
// Algorithm for Polygon Rasterization", 1988). The methods differ in which samples on an edge they accept.
#pragma once

#include <limits>

#include "lab/coverage_plot.h"

namespace edgewise::lab {

template <typename Real>
struct RealEdge {
  Real a, b, x, y;  // E(s) = a (s.x - x) + b (s.y - y), positive inside
  Real threshold;   // inside: E > threshold

  Real at(Real sx, Real sy) const { return a * (sx - x) + b * (sy - y); }
};

// The largest number below zero as threshold makes ">" a ">=".
template <typename Real>
inline constexpr Real kAcceptZero = -std::numeric_limits<Real>::denorm_min();

struct RealBox {
  int x0, y0, x1, y1;
};

inline RealBox real_box(const UnsnappedTriangle& t, Window w) {
  const auto [min_x, max_x] = std::minmax({t.x_px[0], t.x_px[1], t.x_px[2]});
  const auto [min_y, max_y] = std::minmax({t.y_px[0], t.y_px[1], t.y_px[2]});
  return {std::max(ceil_int(min_x - 0.5f), w.x0), std::max(ceil_int(min_y - 0.5f), w.y0),
          std::min(floor_int(max_x - 0.5f) + 1, w.x1()), std::min(floor_int(max_y - 0.5f) + 1, w.y1())};
}

// Calls body(edges), with vertices swapped where the winding asks for it; not at all for a triangle without
// area.
template <typename Real, class Threshold, class Body>
void with_edges(const UnsnappedTriangle& t, Body&& body) {
  Real x[3], y[3];
  for (int i = 0; i < 3; ++i) x[i] = Real{t.x_px[i]}, y[i] = Real{t.y_px[i]};
  const Real area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  if (area == 0) return;
  if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
  RealEdge<Real> edges[3];
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const Real a = y[i] - y[j], b = x[j] - x[i];
    edges[i] = {a, b, x[i], y[i], Threshold::template of<Real>(a, b)};
  }
  body(edges);
}

// "&" rather than "&&": one branch to mispredict, not three.
template <typename Real, class Threshold, class Plot>
void cover_directly(const UnsnappedTriangle& t, Window window, Plot& plot) {
  const RealBox box = real_box(t, window);
  if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
  with_edges<Real, Threshold>(t, [&](const RealEdge<Real>(&edges)[3]) {
    plot.begin();
    const RealEdge<Real> e0 = edges[0], e1 = edges[1], e2 = edges[2];
    for (int y = box.y0; y < box.y1; ++y) {
      const Real sy = static_cast<Real>(y) + Real{0.5f};
      for (int x = box.x0; x < box.x1; ++x) {
        const Real sx = static_cast<Real>(x) + Real{0.5f};
        if ((e0.at(sx, sy) > e0.threshold) & (e1.at(sx, sy) > e1.threshold) & (e2.at(sx, sy) > e2.threshold))
          plot.pixel(x, y);
      }
    }
  });
}

struct AcceptEdges {
  template <typename Real>
  static Real of(Real, Real) {
    return kAcceptZero<Real>;
  }
};
struct RejectEdges {
  template <typename Real>
  static Real of(Real, Real) {
    return 0;
  }
};
struct TopLeft {
  template <typename Real>
  static Real of(Real a, Real b) {
    return a > 0 || (a == 0 && b > 0) ? kAcceptZero<Real> : 0;
  }
};

// A float evaluation errs by less than 4 * 2^-24 of |a dx| + |b dy|, which is at most the edge's length times
// the distance, up to 4096 sqrt(2) px: 0.0014 px off the edge's line, and twice that where it misjudges the
// winding.
inline constexpr double kFloatReachPx = 0.0028;

}  // namespace edgewise::lab

// Edge functions evaluated directly at each tested sample, in floats or doubles (Pineda, "A Parallel
// Algorithm for Polygon Rasterization", 1988). The methods differ in which samples on an edge they accept.
//
// A row's accepted samples are one interval despite rounding, since rounding is monotone. As s.x grows, the
// rounded s.x - x does not fall; its rounded product with a is monotone, in the direction given by the sign
// of a; and the rounded sum with the row's constant stays monotone, also if fused. So each computed edge
// function is monotone along a row, and exceeds its threshold on one side of a crossing only.
#pragma once

#include <cmath>
#include <limits>

#include "lab/coverage/plot.h"

namespace edgewise::lab {

// a b + c, in one rounding if fused.
template <bool kFused, typename Real>
Real multiply_add(Real a, Real b, Real c) {
  return kFused ? std::fma(a, b, c) : a * b + c;
}

template <typename Real, bool kFused = false>
struct RealEdge {
  Real a, b, x, y;  // E(s) = a (s.x - x) + b (s.y - y), positive inside
  Real threshold;   // inside: E > threshold

  Real at(Real sx, Real sy) const { return a * (sx - x) + b * (sy - y); }

  struct Row {
    Real a, x, down, threshold;
    bool accepts(int px) const {
      return multiply_add<kFused>(a, static_cast<Real>(px) + Real{0.5f} - x, down) > threshold;
    }
  };
  Row row(int py) const { return {a, x, b * (static_cast<Real>(py) + Real{0.5f} - y), threshold}; }
  bool faces_right() const { return a >= 0; }
};

// With the largest number below zero as threshold, ">" means ">= 0".
template <typename Real>
inline constexpr Real kAcceptZero = -std::numeric_limits<Real>::denorm_min();

inline PixelBounds real_box(const UnsnappedTriangle& t, Window w) {
  // Nested std::min of two values compiles to branch-free instructions; an initializer list does not.
  const auto least = [](const float(&v)[3]) { return std::min(std::min(v[0], v[1]), v[2]); };
  const auto most = [](const float(&v)[3]) { return std::max(std::max(v[0], v[1]), v[2]); };
  const float min_x = least(t.x_px), max_x = most(t.x_px), min_y = least(t.y_px), max_y = most(t.y_px);
  return {std::max(ceil_int(min_x - 0.5f), w.x0), std::max(ceil_int(min_y - 0.5f), w.y0),
          std::min(floor_int(max_x - 0.5f) + 1, w.x1()), std::min(floor_int(max_y - 0.5f) + 1, w.y1())};
}

// Calls body(edges, box), with two vertices swapped for counter-clockwise triangles. Does not call it for a
// triangle without area or outside the window.
template <typename Real, class Threshold, class Body>
void with_edges(const UnsnappedTriangle& t, Window window, Body&& body) {
  const PixelBounds box = real_box(t, window);
  if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
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
  body(edges, box);
}

// "&" rather than "&&": one branch to mispredict, not three.
template <typename Real, bool kFused, class Plot>
void test_every_pixel(const RealEdge<Real, kFused> (&edges)[3], const PixelBounds& box, Plot& plot) {
  const RealEdge<Real, kFused> e0 = edges[0], e1 = edges[1], e2 = edges[2];
  for (int y = box.y0; y < box.y1; ++y) {
    const auto row0 = e0.row(y), row1 = e1.row(y), row2 = e2.row(y);
    for (int x = box.x0; x < box.x1; ++x)
      if (row0.accepts(x) & row1.accepts(x) & row2.accepts(x)) plot.pixel(x, y);
  }
}

// Testing every pixel is faster for boxes up to this width.
inline constexpr int kNarrowForReals_px = 6;

// edges-inl.h has the overload for plots in lanes, for edges that are not fused.
template <typename Real, bool kFused, class Plot>
void fill(const RealEdge<Real, kFused> (&edges)[3], const PixelBounds& box, Plot& plot) {
  if (box.x1 - box.x0 <= kNarrowForReals_px)
    test_every_pixel(edges, box, plot);
  else
    fill_between(edges, box, plot);
}

template <typename Real, class Threshold>
struct RealEdges {
  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window window, Plot& plot) {
    with_edges<Real, Threshold>(t, window, [&](const RealEdge<Real>(&edges)[3], const PixelBounds& box) {
      plot.begin();
      fill(edges, box, plot);
    });
  }
};

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

using FloatLe = RealEdges<float, AcceptEdges>;
using FloatLt = RealEdges<float, RejectEdges>;
using FloatTopLeft = RealEdges<float, TopLeft>;
using DoubleTopLeft = RealEdges<double, TopLeft>;

// Edge equations: E(s) = (a s.x + b s.y) + c, c = x y' - x' y for an edge from (x, y) to (x', y').
template <bool kFused>
struct EdgeEquations {
  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window window, Plot& plot) {
    with_edges<float, TopLeft>(t, window, [&](const RealEdge<float>(&edges)[3], const PixelBounds& box) {
      RealEdge<float, kFused> equations[3];
      for (int i = 0; i < 3; ++i) {
        const auto &edge = edges[i], &next = edges[i == 2 ? 0 : i + 1];
        const float c = multiply_add<kFused>(edge.x, next.y, -(next.x * edge.y));
        // A rounded sum v + c has its exact sign, so it is > 0 if v > -c, and >= 0 if v exceeds the largest
        // float below -c.
        const float threshold = edge.threshold < 0 ? std::nextafter(-c, -INFINITY) : -c;
        equations[i] = {edge.a, edge.b, 0, 0, threshold};
      }
      plot.begin();
      fill(equations, box, plot);
    });
  }
};

// A float evaluation errs by less than 4 * 2^-24 (|a dx| + |b dy|), and |a dx| + |b dy| is at most the edge's
// length times the distance, which is up to 4096 sqrt(2) px. That is 0.0014 px off the edge's line, and twice
// that if the winding's sign is wrong.
inline constexpr double kFloatReachPx = 0.0028;
// c's products, up to 2^24, err by half a unit each; all else errs by less than 0.003 px of the edge's
// length. An edge of 1 px or more is wrong within 1.003 px of its line. If only shorter edges are wrong, the
// sample, which lies in the bounding box, is less than sqrt(2) px from a point of each.
inline constexpr double kEquationReachPx = 1.5;

// Float edge functions stepped by additions from the corner of the bounding box, as integers are stepped.
// Every step rounds, and the errors accumulate along rows and columns.
//
// A row's accepted samples are still one interval, since rounding is monotone: rounded additions of a number
// of one sign never change direction. The interval's begin depends on the accumulated errors, so it is
// reached step by step.
//
// edges-inl.h has the overload for plots in lanes.
template <class Plot>
void fill_by_steps(const RealEdge<float> (&edges)[3], const PixelBounds& box, Plot& plot) {
  const RealEdge<float> e0 = edges[0], e1 = edges[1], e2 = edges[2];
  const float sx = static_cast<float>(box.x0) + 0.5f, sy = static_cast<float>(box.y0) + 0.5f;
  float row0 = e0.at(sx, sy), row1 = e1.at(sx, sy), row2 = e2.at(sx, sy);
  for (int y = box.y0; y < box.y1; ++y) {
    float v0 = row0, v1 = row1, v2 = row2;
    int x = box.x0;
    const auto walk_while = [&](bool inside) {
      while (x < box.x1 && ((v0 > e0.threshold) & (v1 > e1.threshold) & (v2 > e2.threshold)) == inside) {
        v0 += e0.a, v1 += e1.a, v2 += e2.a;
        ++x;
      }
    };
    walk_while(false);
    const int begin = x;
    walk_while(true);
    plot.span(y, begin, x);
    row0 += e0.b, row1 += e1.b, row2 += e2.b;
  }
}

struct FloatIncremental {
  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window window, Plot& plot) {
    with_edges<float, TopLeft>(t, window, [&](const RealEdge<float>(&edges)[3], const PixelBounds& box) {
      plot.begin();
      fill_by_steps(edges, box, plot);
    });
  }
};

}  // namespace edgewise::lab

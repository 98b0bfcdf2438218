// Float edge functions stepped by additions from the corner of the bounding box, as integers are stepped.
// Every step rounds, and the errors accumulate along rows and columns.
//
// A row's accepted samples are still one interval, since rounding is monotone: rounded additions of a number
// of one sign never change direction. The interval's begin depends on the accumulated errors, so it is
// reached step by step.
#pragma once

#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

// simd/edges-inl.h has the overload for plots in lanes.
template <class Plot>
void fill_by_steps(const RealEdge<float> (&edges)[3], const PixelRows& box, Plot& plot) {
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
    const PixelRows box = real_box(t, window);
    if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
    with_edges<float, TopLeft>(t, [&](const RealEdge<float>(&edges)[3]) {
      plot.begin();
      fill_by_steps(edges, box, plot);
    });
  }
};

}  // namespace edgewise::lab

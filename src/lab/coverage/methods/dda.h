// Shared by the scanline methods: the vertices sorted from top to bottom, and walks along the edges.
// Neighbours walk a shared edge by the same steps, whether it is their long edge or a short one.
#pragma once

#include <utility>

#include "lab/coverage/plot.h"
#include "lab/coverage/simd/forms.h"

namespace edgewise::lab {

template <typename T>
struct DdaTriangle {
  struct Vertex {
    T x, y;
  };
  Vertex top, middle, bottom;

  DdaTriangle(Vertex a, Vertex b, Vertex c) : top(a), middle(b), bottom(c) {
    if (middle.y < top.y) std::swap(middle, top);
    if (bottom.y < middle.y) std::swap(bottom, middle);
    if (middle.y < top.y) std::swap(middle, top);
  }
};

// Fills rows [begin, end) between the long edge and a short one. Edge: pixel(window) is the first pixel at or
// after the edge in the current row; step() goes to the next row.
template <class Edge, class Plot>
void fill_rows(int begin, int end, Edge& long_edge, Edge& short_edge, bool middle_is_right, Window w,
               Plot& plot) {
  Edge &left = middle_is_right ? long_edge : short_edge, &right = middle_is_right ? short_edge : long_edge;
  for (int y = begin; y < end; ++y) {
    plot.span(y, left.pixel(w), right.pixel(w));
    left.step(), right.step();
  }
}

// Fills rows [begin, end) between the long edge and the two short ones, which meet at row `split`.
template <class Edge, class Triangle, class Plot>
void walk_dda(const Triangle& t, int begin, int split, int end, bool middle_is_right, Window w, Plot& plot) {
  Edge long_edge(t.top.x, t.top.y, t.bottom.x, t.bottom.y, begin);
  if (begin < split) {
    Edge short_edge(t.top.x, t.top.y, t.middle.x, t.middle.y, begin);
    fill_rows(begin, split, long_edge, short_edge, middle_is_right, w, plot);
  }
  if (split < end) {
    Edge short_edge(t.middle.x, t.middle.y, t.bottom.x, t.bottom.y, split);
    fill_rows(split, end, long_edge, short_edge, middle_is_right, w, plot);
  }
}

}  // namespace edgewise::lab

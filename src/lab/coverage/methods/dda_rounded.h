// A scanline rasterizer with vertices rounded to pixels, and with the "height + 1" that avoids a division by
// zero. The slopes of short edges are too small, rows and spans include both ends, and the middle row is
// drawn twice.
#pragma once

#include "lab/coverage/methods/dda.h"

namespace edgewise::lab {

struct DdaRounded {
  // Fills the rows from one vertex down to another, both included. The long edge needs no + 1: its height is
  // not 0.
  template <class Plot>
  static void half(DdaTriangle<int>::Vertex top, float long_slope, DdaTriangle<int>::Vertex from,
                   DdaTriangle<int>::Vertex to, Window w, Plot& plot) {
    const int segment_height = to.y - from.y + 1;
    const float short_slope = static_cast<float>(to.x - from.x) / static_cast<float>(segment_height);
    for (int y = std::max(from.y, w.y0); y <= std::min(to.y, w.y1() - 1); ++y) {
      const int a = top.x + static_cast<int>(long_slope * static_cast<float>(y - top.y)),
                b = from.x + static_cast<int>(short_slope * static_cast<float>(y - from.y));
      plot.span(y, std::max(std::min(a, b), w.x0), std::min(std::max(a, b) + 1, w.x1()));
    }
  }

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    const auto vertex = [&](int i) {
      return DdaTriangle<int>::Vertex{floor_int(t.x_px[i]), floor_int(t.y_px[i])};
    };
    const auto [top, middle, bottom] = DdaTriangle<int>(vertex(0), vertex(1), vertex(2));
    if (top.y == bottom.y) return;
    plot.begin();
    const float long_slope = static_cast<float>(bottom.x - top.x) / static_cast<float>(bottom.y - top.y);
    half(top, long_slope, top, middle, w, plot);
    half(top, long_slope, middle, bottom, w, plot);
  }
};

}  // namespace edgewise::lab

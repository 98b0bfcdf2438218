// The scanline rasterizer with vertices rounded to pixels and the "height + 1" that avoids a division by
// zero. The short edges' slopes come out too small, rows and spans include both ends, and the middle row is
// drawn twice.
#include "lab/coverage/methods/dda.h"

namespace edgewise::lab {

namespace {

struct DdaRounded {
  // Rows from one vertex down to another, both included. The long edge has no + 1: it is higher than nothing.
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

}  // namespace

CoverageMethod make_coverage_dda_rounded();
CoverageMethod make_coverage_dda_rounded() {
  // Vertices move by 0.71 px at most, the + 1 bends an edge by less than a row, and x is cut to the pixel.
  return make_coverage_method<DdaRounded>(
      {"dda_rounded", "scanline between vertices rounded to pixels, ends included, height + 1",
       "tinyrenderer's lesson 2 in its first form", "wrong only within 2.75 px of an edge", false},
      {.reach_px = 2.75});
}

}  // namespace edgewise::lab

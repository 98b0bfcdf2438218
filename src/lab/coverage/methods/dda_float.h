// A scanline rasterizer in floats, as in many engines: each edge's x grows by its slope from row to row, and
// rounding errors accumulate. Neighbours make the same errors at a shared edge, so there are no gaps, but
// edges are displaced.
#pragma once

#include "lab/coverage/methods/dda.h"

namespace edgewise::lab {

struct DdaFloat {
  class Edge {
   public:
    Edge(float px, float py, float qx, float qy, int first_row) {
      slope_ = (qx - px) / (qy - py);
      x_ = px + slope_ * (static_cast<float>(first_row) + 0.5f - py) - 0.5f;
    }
    // Clamps before the conversion to int: x may be infinite or NaN if a slope is infinite.
    int pixel(Window w) const {
      const float low = static_cast<float>(w.x0), high = static_cast<float>(w.x1());
      return ceil_int(x_ > low ? (x_ < high ? x_ : high) : low);
    }
    void step() { x_ += slope_; }

   private:
    float slope_, x_;  // x_ is half a pixel less, so that samples lie at whole numbers
  };

  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window w, Plot& plot) {
    const DdaTriangle<float> sorted({t.x_px[0], t.y_px[0]}, {t.x_px[1], t.y_px[1]}, {t.x_px[2], t.y_px[2]});
    const auto& [top, middle, bottom] = sorted;
    const auto row_at = [&](float y) { return std::clamp(ceil_int(y - 0.5f), w.y0, w.y1()); };
    const int begin = row_at(top.y), split = row_at(middle.y), end = row_at(bottom.y);
    const float side = (middle.x - top.x) * (bottom.y - top.y) - (middle.y - top.y) * (bottom.x - top.x);
    if (begin >= end || side == 0.0f) return;
    plot.begin();
    walk_dda<Edge>(sorted, begin, split, end, side > 0.0f, w, plot);
  }
};

}  // namespace edgewise::lab

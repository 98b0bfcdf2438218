// Float edge functions on vertices snapped to 1/256 px, so that differences are exact. A product that needs
// more than 24 bits is rounded: two different products may become equal, and the tie rule then decides a
// false tie.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

namespace {

struct FloatSnapped {
  template <class Plot>
  static void cover(const UnsnappedTriangle& t, Window window, Plot& plot) {
    const auto snap = [](float px) {
      return static_cast<float>(round_half_even(double{px} * 256.0)) / 256.0f;
    };
    UnsnappedTriangle on_grid = t;
    for (int i = 0; i < 3; ++i) {
      on_grid.x_px[i] = snap(t.x_px[i]);
      on_grid.y_px[i] = snap(t.y_px[i]);
    }
    cover_directly<float, TopLeft>(on_grid, window, plot);
  }
};

}  // namespace

CoverageMethod make_coverage_float_snapped();
CoverageMethod make_coverage_float_snapped() {
  return make_coverage_method<FloatSnapped>(
      {"float_snapped", "float edge functions with the top-left rule, vertices snapped to 1/256 px",
       "Scratchapixel's, after Direct3D's snapping", "wrong only within 0.0056 px of an edge", false},
      {.reach_px = 0.00277 + kFloatReachPx});
}

}  // namespace edgewise::lab

// The inside test of many tutorials with "<= 0" for all three edges: samples on a shared edge are drawn
// twice.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_float_le();
CoverageMethod make_coverage_float_le() {
  return make_coverage_method<FloatLe>(
      {"float_le", "float inside test that accepts all edges (<= 0)", "the Pico-8 engine's \"inside test\"",
       "wrong only within 0.0028 px of an edge; no gaps if all vertices lie on the 1/256 px grid", false},
      {.reach_px = kFloatReachPx, .no_gaps = true, .if_on_grid = true}, simd_forms<FloatLe>);
}

}  // namespace edgewise::lab

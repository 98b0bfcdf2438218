// The inside test of many tutorials with "< 0" for all three edges: samples on a shared edge are not drawn.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_float_lt();
CoverageMethod make_coverage_float_lt() {
  return make_coverage_method<FloatLt>(
      {"float_lt", "float inside test that rejects all edges (< 0)", "the Pico-8 engine's \"culling\"",
       "wrong only within 0.0028 px of an edge; no double hits if all vertices lie on the 1/256 px grid",
       false},
      {.reach_px = kFloatReachPx, .no_double_hits = true, .if_on_grid = true}, simd_forms<FloatLt>);
}

}  // namespace edgewise::lab

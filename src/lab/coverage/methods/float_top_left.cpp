// Float edge functions without snapping: the right tie rule on rounded values. Two neighbours evaluate their
// shared edge from different ends, so their rounding errors may differ.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_float_top_left();
CoverageMethod make_coverage_float_top_left() {
  return make_coverage_method<FloatTopLeft>(
      {"float_top_left", "float edge functions with the top-left rule, vertices not snapped",
       "Scratchapixel, \"Rasterization: a Practical Implementation\"",
       "wrong only within 0.0028 px of an edge", false},
      {.reach_px = kFloatReachPx}, simd_forms<FloatTopLeft>);
}

}  // namespace edgewise::lab

// Float edge functions on vertices snapped to 1/256 px, so that differences are exact. A product that needs
// more than 24 bits is rounded: two different products may become equal, and the tie rule then decides a
// false tie.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_float_snapped();
CoverageMethod make_coverage_float_snapped() {
  return make_coverage_method<FloatSnapped>(
      {"float_snapped", "float edge functions with the top-left rule, vertices snapped to 1/256 px",
       "Scratchapixel's, after Direct3D's snapping", "wrong only within 0.0056 px of an edge", false},
      {.reach_px = 0.00277 + kFloatReachPx}, simd_forms<FloatSnapped>);
}

}  // namespace edgewise::lab

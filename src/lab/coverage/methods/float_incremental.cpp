#include "lab/coverage/methods/float_incremental.h"

namespace edgewise::lab {

CoverageMethod make_coverage_float_incremental();
CoverageMethod make_coverage_float_incremental() {
  // A step errs by 2^-24 of the value, which is the edge's length times the distance from its line. Over 4096
  // rows and 4096 columns to a pixel on the line, these distances sum to at most 4096^2 sqrt(1 / 4 + 9 / 4)
  // px.
  return make_coverage_method<FloatIncremental>(
      {"float_incremental", "float edge functions stepped by additions, top-left rule",
       "Pineda 1988, in floats", "wrong only within 1.6 px of an edge", false},
      {.reach_px = 1.6}, simd_forms<FloatIncremental>);
}

}  // namespace edgewise::lab

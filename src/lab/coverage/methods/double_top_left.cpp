// Edge functions in double on unsnapped vertices. Products of two floats are exact in double, but the
// differences before them may round.
#include "lab/coverage/methods/float_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_double_top_left();
CoverageMethod make_coverage_double_top_left() {
  return make_coverage_method<DoubleTopLeft>(
      {"double_top_left", "double edge functions with the top-left rule, vertices not snapped",
       "the usual remedy for float errors", "wrong only within 1e-11 px of an edge", false},
      {.reach_px = 1e-11}, simd_forms<DoubleTopLeft>);  // as kFloatReachPx, with 2^-53 for 2^-24
}

}  // namespace edgewise::lab

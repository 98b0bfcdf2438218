#include "lab/coverage/methods/dda_float.h"

namespace edgewise::lab {

CoverageMethod make_coverage_dda_float();
CoverageMethod make_coverage_dda_float() {
  // Up to 4096 steps, each with an error of half an ulp of a number below 4096: 2^-13 px. The first row's
  // error is small.
  return make_coverage_method<DdaFloat>(
      {"dda_float", "scanline, x of an edge accumulated in float from row to row",
       "Hecker, \"Perspective Texture Mapping\", part I, 1995",
       "wrong only within 0.51 px of an edge; no gaps", false},
      {.reach_px = 0.51, .no_gaps = true}, simd_forms<DdaFloat>);
}

}  // namespace edgewise::lab

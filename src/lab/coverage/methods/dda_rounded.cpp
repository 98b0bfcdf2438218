#include "lab/coverage/methods/dda_rounded.h"

namespace edgewise::lab {

CoverageMethod make_coverage_dda_rounded();
CoverageMethod make_coverage_dda_rounded() {
  // Vertices move by at most 0.71 px, the + 1 moves an edge by less than a row, and x is truncated to a
  // pixel.
  return make_coverage_method<DdaRounded>(
      {"dda_rounded", "scanline between vertices rounded to pixels, ends included, height + 1",
       "tinyrenderer's lesson 2 in its first form", "wrong only within 2.75 px of an edge", false},
      {.reach_px = 2.75}, simd_forms<DdaRounded>);
}

}  // namespace edgewise::lab

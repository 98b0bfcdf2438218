#include "lab/coverage/methods/dda_16_16.h"

namespace edgewise::lab {

CoverageMethod make_coverage_dda_16_16();
CoverageMethod make_coverage_dda_16_16() {
  // A slope errs by less than 2^-16 px per row, over up to 4096 rows; a vertex errs by half of 2^-16 px.
  return make_coverage_method<Dda1616>(
      {"dda_16_16", "scanline, x of an edge accumulated in 16.16 fixed point",
       "Byggmastar, \"Fast affine texture mapping II\", 1997",
       "wrong only within 0.063 px of an edge; no gaps; wraps past 32767 px", false},
      {.reach_px = 0.063, .no_gaps = true}, simd_forms<Dda1616>);
}

}  // namespace edgewise::lab

// Sixteen subpixel bits: 64-bit edge values suffice for triangles of up to 16384 px.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_16();
CoverageMethod make_coverage_fixed_16() {
  return make_fixed_method<16>({"fixed_16", "vertices snapped to 1/65536 px, 64-bit edge functions",
                                "16.16 coordinates, with wide products",
                                "wrong only within 0.0000108 px of an edge; watertight", false});
}

}  // namespace edgewise::lab

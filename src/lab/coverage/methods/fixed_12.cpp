// Twelve subpixel bits: a sixteenth of the snapping error, and six more bits in each product.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_12();
CoverageMethod make_coverage_fixed_12() {
  return make_fixed_method<12>({"fixed_12", "vertices snapped to 1/4096 px, 64-bit edge functions",
                                "finer than any graphics API asks for",
                                "wrong only within 0.000173 px of an edge; watertight", false});
}

}  // namespace edgewise::lab

// Eight subpixel bits, as Direct3D requires. Snaps like our contract, but shares no loop with the backends.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_8();
CoverageMethod make_coverage_fixed_8() {
  return make_fixed_method<8>({"fixed_8", "vertices snapped to 1/256 px, 64-bit edge functions",
                               "Direct3D 11.3 functional specification, 3.4.1",
                               "exact coverage of the positions snapped to 1/256 px", true});
}

}  // namespace edgewise::lab

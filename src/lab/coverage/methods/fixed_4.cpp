// Four subpixel bits, as in the first 3D accelerators and many software rasterizers since.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_4();
CoverageMethod make_coverage_fixed_4() {
  return make_fixed_method<4>({"fixed_4", "vertices snapped to 1/16 px, 64-bit edge functions",
                               "Giesen, \"Triangle rasterization in practice\"",
                               "wrong only within 0.0442 px of an edge; watertight", false});
}

}  // namespace edgewise::lab

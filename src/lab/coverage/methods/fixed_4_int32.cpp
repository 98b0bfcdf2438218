// Four subpixel bits and 32-bit edge values, as in many software rasterizers. No value wraps while a
// triangle's box is at most 2896 px per side: its area is then at most 46336^2 square units, below 2^31. With
// 2897 px it is above.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_4_int32();
CoverageMethod make_coverage_fixed_4_int32() {
  using Method = FixedEdges<4, std::int32_t>;
  return make_coverage_method<Method>(
      {"fixed_4_int32", "vertices snapped to 1/16 px, 32-bit edge functions that wrap",
       "Giesen, \"Triangle rasterization in practice\", at the range it states",
       "as fixed_4 for triangles of at most 2896 px; anything inside the bounding box beyond", false},
      {.reach_px = snap_reach_px(4), .max_side_px = 2896, .no_gaps = true, .no_double_hits = true},
      simd_forms<Method>);
}

}  // namespace edgewise::lab

// Eight subpixel bits and 32-bit edge values. No value wraps while a triangle's box is at most 181 px per
// side: the box's area in square units is then below 2^31, and no value at a sample in the box is larger.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_fixed_8_int32();
CoverageMethod make_coverage_fixed_8_int32() {
  using Method = FixedEdges<8, std::int32_t>;
  return make_coverage_method<Method>(
      {"fixed_8_int32", "vertices snapped to 1/256 px, 32-bit edge functions that wrap",
       "Giesen, \"Triangle rasterization in practice\", past the range it states",
       "as fixed_8 for triangles of at most 181 px; anything inside the bounding box beyond", false},
      {.reach_px = snap_reach_px(8), .max_side_px = 181, .no_gaps = true, .no_double_hits = true},
      simd_forms<Method>);
}

}  // namespace edgewise::lab

// Vertices rounded to whole pixels: moving edges jitter, and small triangles vanish or flip.
#include "lab/coverage/methods/fixed_edges.h"

namespace edgewise::lab {

CoverageMethod make_coverage_whole_pixel();
CoverageMethod make_coverage_whole_pixel() {
  return make_fixed_method<0>({"whole_pixel", "vertices rounded to whole pixels, exact integers after that",
                               "engines of the 8- and 16-bit home computers",
                               "wrong only within 0.708 px of an edge; watertight", false});
}

}  // namespace edgewise::lab

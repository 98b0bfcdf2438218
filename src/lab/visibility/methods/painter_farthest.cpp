// The painter's algorithm by the farthest vertex.
#include "lab/visibility/methods/painter.h"

namespace edgewise::lab {

extern const VisibilityMethod visibility_painter_farthest;
const VisibilityMethod visibility_painter_farthest{
    {"painter_farthest", "farthest vertex first, later ones overwrite",
     "Newell, Newell and Sancha 1972, their first sort only",
     "right where any two polygons that meet on the screen have depth ranges apart", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_painter(scene, frame, farthest_distance);
    },
    nullptr,
    nullptr,
    nullptr,
    ranges_overlap};

}  // namespace edgewise::lab

// The painter's algorithm by the mean of the vertices' distances, the order of the p5.js engine.
#include "lab/visibility/methods/painter.h"

namespace edgewise::lab {

extern const VisibilityMethod visibility_painter_mean;
const VisibilityMethod visibility_painter_mean{
    {"painter_mean", "farthest mean distance first, later ones overwrite", "p5.js engine",
     "right where any two polygons that meet on the screen have depth ranges apart", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) { draw_painter(scene, frame, mean_distance); },
    nullptr,
    nullptr,
    nullptr,
    ranges_overlap};

}  // namespace edgewise::lab

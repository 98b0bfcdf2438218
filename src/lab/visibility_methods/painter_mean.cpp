// The painter's algorithm by the mean of the vertices' distances, as the p5.js engine sorts.
#include "lab/visibility_methods/painter.h"

namespace edgewise::lab {

extern const VisibilityMethod visibility_painter_mean;
const VisibilityMethod visibility_painter_mean{
    {"painter_mean", "farthest mean distance first, later ones overwrite", "p5.js engine",
     "right where any two triangles that meet on the screen have depth ranges apart", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      draw_painter(scene, frame,
                   [](const VisibilityTriangle& t) { return t.view_z[0] + t.view_z[1] + t.view_z[2]; });
    },
    nullptr,
    nullptr,
    nullptr};

}  // namespace edgewise::lab

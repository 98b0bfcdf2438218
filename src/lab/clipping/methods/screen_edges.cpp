// Sutherland and Hodgman's clipping at the screen's four edges, after projection. The new vertices are
// snapped, which moves the edges on which they lie.
#include "lab/clipping/methods/screen_clip.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_screen_edges;
const ClippingMethod clipping_screen_edges{
    {"screen_edges", "near and far planes, then the screen's four edges after projection", "p5.js engine",
     "as near_guard, up to 2^17 px instead of 2^40; edges clipped at the screen may move by 1/256 px, which "
     "changes long runs of pixels if they are nearly horizontal",
     false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      const auto between = [](const Projected& a, const Projected& b, float t) {
        return Projected{a.x_px + t * (b.x_px - a.x_px), a.y_px + t * (b.y_px - a.y_px),
                         a.z01 + t * (b.z01 - a.z01)};
      };
      const auto project = [&](const ClipVertex& v) { return divide(v, frame.view); };
      draw_screen_clipped(scene, frame, project, between, [](const Projected& p) { return p; });
    },
    0,
    kReachPx / 2};

}  // namespace edgewise::lab

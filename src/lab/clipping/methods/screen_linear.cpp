// screen_edges for vertices that carry w: on the screen 1 / w is linear and w is not, so a new vertex gets a
// wrong w. The same happens to any other attribute that was not divided by w.
#include "lab/clipping/methods/screen_clip.h"

namespace edgewise::lab {

namespace {

struct AtDistance {
  float x_px, y_px, w;
};

}  // namespace

extern const ClippingMethod clipping_screen_linear;
const ClippingMethod clipping_screen_linear{
    {"screen_linear", "the same, with w interpolated linearly where an edge is cut",
     "what the p5.js engine's clipping does to any attribute",
     "as screen_edges where nothing is cut; else distances from w0 to w1 come out too far by up to "
     "(sqrt w1 - sqrt w0)^2",
     false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      const float near_z = scene.scene.camera.near_z, far_z = scene.scene.camera.far_z;
      const float depth_scale = far_z / (far_z - near_z);
      const auto project = [&](const ClipVertex& v) {
        const Projected p = divide(v, frame.view);
        return AtDistance{p.x_px, p.y_px, static_cast<float>(v.w)};
      };
      const auto between = [](const AtDistance& a, const AtDistance& b, float t) {
        return AtDistance{a.x_px + t * (b.x_px - a.x_px), a.y_px + t * (b.y_px - a.y_px),
                          a.w + t * (b.w - a.w)};
      };
      draw_screen_clipped(scene, frame, project, between, [&](const AtDistance& v) {
        return Projected{v.x_px, v.y_px, depth_scale * (1.0f - near_z / v.w)};
      });
    },
    kLeft | kRight | kTop | kBottom,
    kReachPx / 2};

}  // namespace edgewise::lab

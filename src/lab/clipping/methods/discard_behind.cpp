// No near clipping: discards a triangle that has a vertex nearer than the near plane or behind the camera.
#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_discard_behind;
const ClippingMethod clipping_discard_behind{
    {"discard_behind", "discards triangles that have a vertex before the near plane", "many small engines",
     "right where no vertex is nearer than the near plane", false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
        const auto sides = sides_of(triangle, frame.view);
        if (!sides || (*sides & kNear) != 0) return;
        emit(frame.clipper.clip(triangle, *sides & (kFar | kGuard), frame.view), payload, scene.cull_back,
             frame);
      });
    },
    kNear,
    kReachPx};

}  // namespace edgewise::lab

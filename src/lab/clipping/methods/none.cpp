// No clipping: divides by w whatever its sign.
#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_none;
const ClippingMethod clipping_none{
    {"none", "no clipping: divides by w even if w ≤ 0", "the trainer's first steps",
     "right where every vertex lies between near and far and within the guard band", false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
        emit(std::span<const ClipVertex>(triangle), payload, scene.cull_back, frame);
      });
    },
    kNear | kFar | kGuard,
    kReachPx};

}  // namespace edgewise::lab

// Clips at a tenth of the projection's near distance: at 0.01 for a near plane of 0.1. Points between have
// depths below 0, which are clamped here; in other programs they wrap.
#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_near_too_near;
const ClippingMethod clipping_near_too_near{
    {"near_too_near", "near plane clipped at 0.01 under a projection whose near is 0.1",
     "a tutorial's mismatch of constants", "right where nothing is nearer than the near plane", false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      const float clip_w = scene.scene.camera.near_z * 0.1f;
      draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
        ClipVertex polygon[4];
        const auto count = cut<ClipVertex>(
            triangle, polygon, [&](const ClipVertex& v) { return v.w - clip_w; }, lerp);
        for (std::size_t i = 2; i < count; ++i) {
          const ClipVertex piece[3] = {polygon[0], polygon[i - 1], polygon[i]};
          emit(frame.clipper.clip(piece, kFar | kGuard, frame.view), payload, scene.cull_back, frame);
        }
      });
    },
    kNear,
    kReachPx};

}  // namespace edgewise::lab

// Ours: the library's front end. Clips at the near and far planes and at the guard band, in homogeneous
// space. The backend restricts triangles to the image.
#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_near_guard;
const ClippingMethod clipping_near_guard{
    {"near_guard", "ours: near and far by view distance, guard band; in double", "frontend/clip.h",
     "differences within 1/64 px, if no edge across the screen has both ends over 2^40 px out; visible "
     "triangles right if depths, from 0 to 1, are over 2^-22 apart: z^2 / (2^22 near) at a distance z",
     true},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      FrontendOptions options;
      options.width = scene.size.width;
      options.height = scene.size.height;
      options.cull = scene.cull_back ? Cull::back : Cull::none;
      options.payload = Payload::id;
      frame.backend->draw(frame.frontend.run(scene.scene, options), frame.picture.view(), kNoTriangle, {});
    },
    0,
    kDoubleReachPx};

}  // namespace edgewise::lab

#include "lab/clipping/methods/matrix.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_matrix_relative;
const ClippingMethod clipping_matrix_relative{
    {"matrix_relative", "the same, after subtracting the camera from positions in float",
     "\"camera-relative rendering\" of engines with large worlds",
     "as near_guard, up to 2^17 px instead of 2^40; planes less than a factor of 2^16 apart, which cut "
     "nothing",
     false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      draw_by_matrix(scene, frame, glm::vec3(scene.scene.camera.position));
    },
    kNear | kFar,
    kReachPx / 2,
    true,
    1 << 16};

}  // namespace edgewise::lab

#include "lab/clipping/methods/matrix.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_matrix_float;
const ClippingMethod clipping_matrix_float{
    {"matrix_float", "one 4×4 matrix of floats; near and far by 0 ≤ z ≤ w", "OpenGL, Direct3D, most engines",
     "as near_guard, up to 2^17 px instead of 2^40; camera at the origin; planes less than a factor of 2^16 "
     "apart, which cut nothing",
     false},
    [](const ClippingScene& scene, ClippingFrame& frame) { draw_by_matrix(scene, frame, glm::vec3(0.0f)); },
    kNear | kFar,
    kReachPx / 2,
    false,
    1 << 16};

}  // namespace edgewise::lab

// The sign of z of the rotated normal, as if every ray had the view direction.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_normal_z;
const FacingMethod facing_normal_z{
    {"normal_z", "z of the rotated normal before projection", "Outlaw Triad",
     "orthographic: wrong only where a face is edge-on up to rounding; perspective: wrong by the ray's tilt",
     false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      classify_each(scene, front, [forward = scene.view.forward](glm::vec3 normal, const glm::vec3*) {
        return glm::dot(normal, forward) < 0.0f;
      });
    },
    [](const FaceFacts& face, const FacingView& view) {
      return face.sine <= ray_rounding(face) + (view.perspective ? face.tilt_sine : 0.0);
    },
    true,
    true};

}  // namespace edgewise::lab

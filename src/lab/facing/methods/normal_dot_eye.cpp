// Dot product of the world-space normal and the ray from the camera to a vertex: needs no projection.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_normal_dot_eye;
const FacingMethod facing_normal_dot_eye{
    {"normal_dot_eye", "world-space normal times the ray to a vertex, <= 0", "REALbasic engine",
     "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
     false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
        return glm::dot(normal, v[0] - eye) <= 0.0f;
      });
    },
    ray_may_err,
    true};

}  // namespace edgewise::lab

// Dot product of the normal and the mean of the unit rays to the vertices.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_normal_dot_mean_ray;
const FacingMethod facing_normal_dot_mean_ray{
    {"normal_dot_mean_ray", "normal times the mean of the unit rays to the vertices",
     "a mean-direction variant",
     "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
     false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      classify_each(scene, front, [eye = scene.view.eye](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const glm::vec3 rays = glm::normalize(a - eye) + glm::normalize(b - eye) + glm::normalize(c - eye);
        return glm::dot(normal_of(a, b, c), rays) < 0.0f;
      });
    },
    ray_may_err};

}  // namespace edgewise::lab

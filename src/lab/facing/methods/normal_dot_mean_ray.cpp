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
      classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
        const glm::vec3 rays =
            glm::normalize(v[0] - eye) + glm::normalize(v[1] - eye) + glm::normalize(v[2] - eye);
        return glm::dot(normal, rays) < 0.0f;
      });
    },
    ray_may_err,
    true};

}  // namespace edgewise::lab

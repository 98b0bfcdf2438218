// Dot product of the normal and the ray to the mean of the vertices.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_normal_dot_centroid;
const FacingMethod facing_normal_dot_centroid{
    {"normal_dot_centroid", "normal times the ray to the first three vertices' mean",
     "a mean-direction variant",
     "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
     false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
        return glm::dot(normal, (v[0] + v[1] + v[2]) * (1.0f / 3.0f) - eye) < 0.0f;
      });
    },
    ray_may_err,
    true};

}  // namespace edgewise::lab

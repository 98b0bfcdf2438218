// Dot product of the normal and one ray for the whole object, as if the object were far away.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_normal_dot_object;
const FacingMethod facing_normal_dot_object{
    {"normal_dot_object", "normal times one ray for all faces, to the mean of all vertices",
     "a mean-direction variant",
     "wrong by the angle between a face's ray and the object's; orthographic: by the ray's tilt too", false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      glm::vec3 sum(0.0f);
      for (const auto& p : scene.positions) sum += p;
      const glm::vec3 ray = sum / static_cast<float>(scene.positions.size()) - scene.view.eye;
      classify_each(scene, front,
                    [ray](glm::vec3 normal, const glm::vec3*) { return glm::dot(normal, ray) < 0.0f; });
    },
    [](const FaceFacts& face, const FacingView& view) {
      return face.sine <= ray_rounding(face) + face.object_sine + (view.perspective ? 0.0 : face.tilt_sine);
    },
    true};

}  // namespace edgewise::lab

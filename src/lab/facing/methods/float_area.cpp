// The sign of the projected area in float, before snapping.
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_float_area;
const FacingMethod facing_float_area{
    {"float_area", "sign of the area of the projected vertices in float", "most software renderers",
     "wrong only about faces narrower on the screen than the rounding of a projected vertex", false},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      const FloatProjector project(scene.view);
      classify_each(scene, front, [&](glm::vec3, const glm::vec3* v) {
        const glm::vec2 p = project(v[0]), q = project(v[1]) - p, r = project(v[2]) - p;
        return q.x * r.y - q.y * r.x > 0.0f;
      });
    },
    [](const FaceFacts& face, const FacingView&) { return face.width_px <= 8 * face.rounding_px; }};

}  // namespace edgewise::lab

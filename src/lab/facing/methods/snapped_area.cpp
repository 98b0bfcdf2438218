// Ours: the sign of the snapped triangle's area, in integers (rule 2).
#include "frontend/fixed.h"
#include "lab/facing/methods/project.h"

namespace edgewise::lab {

extern const FacingMethod facing_snapped_area;
const FacingMethod facing_snapped_area{
    {"snapped_area", "ours: sign of the area of the snapped vertices", "edgewise/contract.h, rule 2",
     "wrong only about faces that are less than 1/128 px wide on the screen, which it draws as they are "
     "snapped",
     true},
    [](const FacingScene& scene, std::span<std::uint8_t> front) {
      const FloatProjector project(scene.view);
      classify_each(scene, front, [&](glm::vec3, const glm::vec3* v) {
        ScreenTriangle t{};
        for (int i = 0; i < 3; ++i) {
          const glm::vec2 p = project(v[i]);
          t.x_sub[i] = snap(p.x);
          t.y_sub[i] = snap(p.y);
        }
        return contract::signed_area(t) > 0;
      });
    },
    // Snapping moves a vertex, and the side opposite to it, by at most sqrt(2) / 512 px each.
    [](const FaceFacts& face, const FacingView&) {
      return face.width_px <= 1.0 / 128 + 4 * face.rounding_px;
    }};

}  // namespace edgewise::lab

// No visibility at all: the last triangle submitted wins.
#include "lab/visibility/methods/painter.h"

namespace edgewise::lab {

extern const VisibilityMethod visibility_submission_order;
const VisibilityMethod visibility_submission_order{
    {"submission_order", "no sort and no depth: the last one submitted wins",
     "Pico-8 inside test with culling off", "right where triangles are submitted back to front", false},
    [](const VisibilityScene& scene, VisibilityFrame& frame) {
      clear_visible(scene, frame);
      for (std::uint32_t id = 0; id < scene.triangles.size(); ++id) paint(scene, frame, id);
    },
    nullptr,
    nullptr,
    nullptr,
    [](const VisibilityScene&, std::uint32_t drawn, std::uint32_t truth) { return truth < drawn; }};

}  // namespace edgewise::lab

#include "bench/workloads/choice.h"

namespace edgewise::bench {

std::function<void()> ChoiceDraw::prepare(std::string& error) const {
  ChoiceFrame& at = *frame;
  if (!at.drawable) {
    at.drawable = at.scene.make(0);
    at.drawer.emplace(at.scene.size);
  }
  lab::FrameDrawer scalar(at.scene.size);
  scalar.draw(*at.drawable, method, Payload::colour, {.target = SimdTarget::scalar});
  at.drawer->draw(*at.drawable, method, Payload::colour);
  if (!lab::same_picture(*method.method, scalar.canvas(), at.drawer->canvas()))
    error = "draws other pixels than its scalar form";
  return [&at, method = method] { at.drawer->draw(*at.drawable, method, Payload::colour); };
}

}  // namespace edgewise::bench

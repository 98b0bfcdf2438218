#include "crowd.h"

#include <algorithm>
#include <cmath>

namespace edgewise::bench {

app::Source crowd(const SceneRequest& request) {
  constexpr int kSide = 6;
  constexpr float kSpacing = 2.6f;  // less than a knot is wide, so that they hide one another
  const int side =
      std::max(1, static_cast<int>(std::lround(kSide * std::sqrt(std::min(request.scale, 1.0)))));
  Scene scene = std::get<Scene>(find_scene("torus-knot").make(request));
  const Instance knot = scene.instances.front();
  scene.instances.clear();
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto at = [&](int i) {
        return kSpacing * (static_cast<float>(i) - 0.5f * static_cast<float>(side - 1));
      };
      Instance instance = knot;
      instance.angle += 0.7f * static_cast<float>(row * side + column);
      instance.translation = {at(column), 0.0f, at(row)};
      scene.instances.push_back(instance);
    }
  const float extent = kSpacing * static_cast<float>(side);
  scene.camera.position = {0.2f * extent, 0.4f * extent, 0.8f * extent};
  scene.camera.look_at({0.0f, -0.5f, 0.0f});
  return {kCrowdName, std::move(scene), false};
}

}  // namespace edgewise::bench

// A scene: a staircase of twenty steps, two rectangles each, that leads up and away from the camera.
#include "edgewise/builtin.h"

namespace edgewise {

namespace {

Drawable make(const SceneRequest& request) {
  constexpr unsigned kSteps = 20;
  Mesh mesh;
  for (unsigned i = 0; i <= 2 * kSteps; ++i) {  // the profile: up, back, up, back …
    const auto up = static_cast<float>((i + 1) / 2), back = static_cast<float>(i / 2);
    mesh.positions.emplace_back(-3.0f, up, -back);
    mesh.positions.emplace_back(3.0f, up, -back);
  }
  for (unsigned i = 0; i < 2 * kSteps; ++i) {
    const unsigned left = 2 * i, right = left + 1, next_left = left + 2, next_right = left + 3;
    mesh.triangles.emplace_back(left, next_left, right);  // clockwise seen from the front
    mesh.triangles.emplace_back(right, next_left, next_right);
    const std::uint32_t colour = i % 2 == 0 ? rgb(150, 110, 80) : rgb(220, 190, 150);
    mesh.colours.insert(mesh.colours.end(), {colour, colour});
  }
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({.mesh = 0, .angle = 0.3f * request.time});
  scene.camera.position = {5.0f, 9.0f, 14.0f};
  scene.camera.look_at({0.0f, 6.0f, -6.0f});
  return scene;
}

}  // namespace

extern const SceneInfo scene_staircase;
const SceneInfo scene_staircase{"staircase", "a staircase of twenty steps", false, make};

}  // namespace edgewise

#include "viewer/world.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "core/trigonometry.h"
#include "frontend/view.h"
#include "scene/origin.h"

namespace edgewise::viewer {

namespace {

constexpr double kMostCoordinate = 1e12;  // world units; bound of the camera's coordinates

glm::quat quaternion(glm::vec3 axis, float angle) {
  const float length = glm::length(axis);
  if (!(length > 0.0f)) return glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  return glm::quat(cosine(0.5f * angle), sine(0.5f * angle) * (axis / length));
}

}  // namespace

World::World(Drawable drawable) : drawable_(std::move(drawable)) {
  auto* const seen = std::get_if<Scene>(&drawable_);
  if (seen == nullptr) return;
  fold_origins(*seen);  // for turn(), whose instances turn about points of their own
  loaded_ = seen->instances;
  home_ = seen->camera;
  const auto [low, high] = bounds_of(*seen);
  const double diagonal = glm::distance(low, high);
  if (!std::isfinite(diagonal)) return;
  middle_ = low + 0.5 * (high - low);
  if (diagonal > 0.0) radius_ = static_cast<float>(0.5 * diagonal);
}

glm::vec3 World::first_axis() const {
  return loaded_.empty() ? glm::vec3(0.0f, 1.0f, 0.0f) : loaded_.front().axis;
}

void World::turn(glm::vec3 axis, float angle) {
  const glm::quat by = quaternion(axis, angle);
  auto& instances = std::get<Scene>(drawable_).instances;
  for (std::size_t i = 0; i < loaded_.size(); ++i) {
    const Instance& from = loaded_[i];
    if (angle == 0.0f) {
      instances[i] = from;  // bit-identical to the loaded scene
      continue;
    }
    const glm::quat both = by * quaternion(from.axis, from.angle);
    instances[i].axis = {both.x, both.y, both.z};
    instances[i].angle = static_cast<float>(2 * arctangent(glm::length(instances[i].axis), both.w));
    instances[i].translation = middle_ + glm::dquat(by) * (from.translation - middle_);
  }
}

void move(Camera& camera, glm::vec3 distance, bool along_view) {
  glm::dvec3 step(distance);
  if (along_view) step = glm::transpose(to_camera_frame(camera)) * step;
  camera.position = glm::clamp(camera.position + step, -kMostCoordinate, kMostCoordinate);
}

void look(Camera& camera, float left, float up) {
  constexpr float kHalfTurn = std::numbers::pi_v<float>, kQuarter = kHalfTurn / 2.0f;
  camera.yaw = std::remainder(camera.yaw + left, 2.0f * kHalfTurn);
  camera.pitch = std::clamp(camera.pitch + up, -kQuarter, kQuarter);
}

}  // namespace edgewise::viewer

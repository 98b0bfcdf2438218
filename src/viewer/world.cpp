#include "viewer/world.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "core/finite.h"
#include "lab/view_space.h"

namespace edgewise::viewer {

namespace {

constexpr float kMostCoordinate = 1e6f;  // world units; bound of the camera's coordinates

glm::quat rotation(glm::vec3 axis, float angle) {
  const float length = glm::length(axis);
  if (!(length > 0.0f)) return glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  return glm::angleAxis(angle, axis / length);
}

}  // namespace

World::World(Drawable drawable) : drawable_(std::move(drawable)) {
  const Scene* const seen = scene();
  if (seen == nullptr) return;
  loaded_ = seen->instances;
  home_ = seen->camera;
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  for (const Instance& instance : loaded_) {
    const glm::mat4 model = model_matrix(instance);
    for (const glm::vec3& position : seen->meshes.at(instance.mesh).positions) {
      const glm::vec3 p(model * glm::vec4(position, 1.0f));
      if (!is_finite(p)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const float diagonal = glm::distance(low, high);
  if (!std::isfinite(diagonal)) return;
  middle_ = low + 0.5f * (high - low);
  if (diagonal > 0.0f) radius_ = 0.5f * diagonal;
}

glm::vec3 World::first_axis() const {
  return loaded_.empty() ? glm::vec3(0.0f, 1.0f, 0.0f) : loaded_.front().axis;
}

void World::turn(glm::vec3 axis, float angle) {
  const glm::quat by = rotation(axis, angle);
  auto& instances = std::get<Scene>(drawable_).instances;
  for (std::size_t i = 0; i < loaded_.size(); ++i) {
    const Instance& from = loaded_[i];
    if (angle == 0.0f) {
      instances[i] = from;  // bit-identical to the loaded scene
      continue;
    }
    const glm::quat both = by * rotation(from.axis, from.angle);
    instances[i].axis = glm::axis(both);
    instances[i].angle = glm::angle(both);
    instances[i].translation = middle_ + by * (from.translation - middle_);
  }
}

void move(Camera& camera, glm::vec3 distance, bool along_view) {
  glm::dvec3 step(distance);
  if (along_view) step = glm::transpose(lab::to_camera_frame(camera)) * step;
  camera.position = glm::clamp(camera.position + glm::vec3(step), -kMostCoordinate, kMostCoordinate);
}

void look(Camera& camera, float left, float up) {
  constexpr float kHalfTurn = std::numbers::pi_v<float>, kQuarter = kHalfTurn / 2.0f;
  camera.yaw = std::remainder(camera.yaw + left, 2.0f * kHalfTurn);
  camera.pitch = std::clamp(camera.pitch + up, -kQuarter, kQuarter);
}

}  // namespace edgewise::viewer

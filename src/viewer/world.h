// The viewer's scene or stream; a scene's camera can be moved and its objects rotated.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "edgewise/scene.h"

namespace edgewise::viewer {

class World {
 public:
  explicit World(Drawable drawable);

  const Drawable& drawable() const { return drawable_; }
  // Null for a stream, which has no camera and no objects.
  const Scene* scene() const { return std::get_if<Scene>(&drawable_); }
  // For a scene only.
  Camera& camera() { return std::get<Scene>(drawable_).camera; }
  const Camera& home() const { return home_; }
  // The first object's rotation axis as loaded.
  glm::vec3 first_axis() const;
  // Half the diagonal of the bounding box of all objects, in world units; 1 if that is 0 or not finite.
  float radius() const { return radius_; }

  // Rotates all objects as loaded about an axis through the middle of their bounding box. Radians.
  void turn(glm::vec3 axis, float angle);

 private:
  Drawable drawable_;
  std::vector<Instance> loaded_;
  Camera home_;
  glm::dvec3 middle_{0.0};
  float radius_ = 1.0f;
};

// Moves the camera by a distance in world units, along its own right, up and backward axes (along_view), or
// along the world's x, y and z axes.
void move(Camera& camera, glm::vec3 distance, bool along_view);
// Turns the camera. Radians; the pitch is clamped to straight up and straight down, where yaw still turns the
// image.
void look(Camera& camera, float left, float up);
}  // namespace edgewise::viewer

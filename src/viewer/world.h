// What is looked at: a scene as it was loaded, with its camera moved and its objects turned.
#pragma once

#include <cstdint>
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
  // Of a scene only.
  Camera& camera() { return std::get<Scene>(drawable_).camera; }
  const Camera& home() const { return home_; }
  // The axis about which the first object was turned when it was loaded.
  glm::vec3 first_axis() const;
  // Half the diagonal of all objects' bounding box, world units.
  float radius() const { return radius_; }

  // Turns all objects together about an axis through the middle of their bounding box, from where they were
  // loaded.
  void turn(glm::vec3 axis, float angle);

 private:
  Drawable drawable_;
  std::vector<Instance> loaded_;
  Camera home_;
  glm::vec3 middle_{0.0f};
  float radius_ = 1.0f;
};

// Moves and turns of a camera. Distances in world units, along the camera's own right, up and backwards, or
// along the world's x, y and z.
void move(Camera& camera, glm::vec3 distance, bool along_view);
// Radians; the pitch stops straight up and down.
void look(Camera& camera, float left, float up);
}  // namespace edgewise::viewer

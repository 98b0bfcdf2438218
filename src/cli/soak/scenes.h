// Families of random scenes that go through the front end; the other pictures of a soak test are triangle
// lists (triangles.h).
#pragma once

#include <span>
#include <string_view>

#include "core/random.h"
#include "edgewise/scene.h"

namespace edgewise::soak {

struct SceneFamily {
  std::string_view name;
  Drawable (*make)(Random& random, int width, int height);  // for an image of that size in pixels
};

std::span<const SceneFamily> scene_families();

}  // namespace edgewise::soak

// Families of whole scenes, which go through the front end: the second half of what a soak draws.
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

// Families of random triangle lists that are hard for a rasterizer; the other pictures of a soak test are
// scenes (scenes.h).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "edgewise/screen_triangle.h"

namespace edgewise::soak {

struct TriangleFamily {
  std::string_view name;
  // Sizes in pixels. All vertices lie in the guard band; payloads are indices.
  std::vector<ScreenTriangle> (*make)(Random& random, int width, int height);
};

std::span<const TriangleFamily> triangle_families();

}  // namespace edgewise::soak

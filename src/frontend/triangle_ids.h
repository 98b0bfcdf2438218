// Ids of a scene's triangles: their numbers in submission order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "edgewise/scene.h"
#include "frontend/scene_checks.h"

namespace edgewise {

// Sets `first_ids`: by instance, its first triangle; then the number of triangles. Throws
// std::invalid_argument for an instance whose mesh the scene lacks.
inline void number_triangles(const Scene& scene, std::vector<std::size_t>& first_ids) {
  first_ids.assign(1, 0);
  for (const Instance& instance : scene.instances)
    first_ids.push_back(first_ids.back() + mesh_of(scene, instance).triangles.size());
}

// The instance of a triangle that the scene has.
inline std::size_t instance_of(const std::vector<std::size_t>& first_ids, std::size_t triangle) {
  const auto after = std::upper_bound(first_ids.begin(), first_ids.end(), triangle);
  return static_cast<std::size_t>(after - first_ids.begin()) - 1;
}

}  // namespace edgewise

// The triangles of a scene in submission order, and checks that the front end, the queries and the interfaces
// for C and Python share. Checks throw std::invalid_argument.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edgewise/scene.h"

namespace edgewise {

// Returns `triangles` unless a frame cannot have so many, with ids from `first_id` on.
std::size_t checked_count(std::size_t triangles, std::uint32_t first_id = 0);

const Mesh& mesh_of(const Scene& scene, const Instance& instance);

// `what` names what is counted.
void check_index(const char* what, std::size_t index, std::size_t count);
void check_count(const char* what, std::size_t given, std::size_t count);

// A direction towards the light, within the range of float.
glm::vec3 checked_light(const glm::dvec3& towards);

// The aspect of frame_camera().
double checked_aspect(double aspect);

// The flags are empty or one per triangle.
void check_flags(const Mesh& mesh);

// The mesh has the part's triangles.
void check_part(const Mesh& mesh, const MeshPart& part);

// All vertices that triangles name exist.
void check_vertices(const Mesh& mesh);

// `first_ids`: by instance, its first triangle; then the number of triangles, which exceeds `triangle`.
inline std::size_t instance_of(const std::vector<std::size_t>& first_ids, std::size_t triangle) {
  const auto after = std::upper_bound(first_ids.begin(), first_ids.end(), triangle);
  return static_cast<std::size_t>(after - first_ids.begin()) - 1;
}

}  // namespace edgewise

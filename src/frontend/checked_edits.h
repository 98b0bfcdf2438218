// Edits of a scene by the interfaces for C and Python. They throw std::invalid_argument before they change
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "edgewise/scene.h"
#include "frontend/mesh_clusters.h"
#include "frontend/scene_checks.h"

namespace edgewise {

inline constexpr std::uint32_t kLightGrey = rgb(200, 200, 200);  // of what has no colours

// Adds a mesh with its clusters and returns its number. If it has no colours, it is light grey.
std::size_t add_mesh(Scene& scene, Mesh mesh);
// Gives triangles of a mesh a name.
void add_part(Scene& scene, std::size_t mesh, MeshPart part);
std::size_t add_instance(Scene& scene, const Instance& instance);
void set_instance(Scene& scene, std::size_t instance, const glm::dmat4& matrix);
void remove_instance(Scene& scene, std::size_t instance);

// A direction towards the light, within the range of float.
glm::vec3 checked_light(const glm::dvec3& towards);
// The aspect of frame_camera().
double checked_aspect(double aspect);

// Sets the vertices of a mesh, whose triangles are there. Doubles keep a point of their own (Mesh::origin).
inline void set_vertices(Mesh& mesh, std::vector<glm::vec3> points) {
  mesh.positions = std::move(points), mesh.origin = glm::dvec3(0.0);
}
inline void set_vertices(Mesh& mesh, const std::vector<glm::dvec3>& points) {
  mesh.set_positions(points);
}

// Moves the vertices of a mesh of the scene to points(), if it has `count` of them.
template <typename Points>
void set_positions(Scene& scene, std::size_t mesh, std::size_t count, Points&& points) {
  check_index("mesh", mesh, scene.meshes.size());
  Mesh& moved = scene.meshes[mesh];
  check_count("vertices", count, moved.positions.size());
  set_vertices(moved, points());
  moved.renew_normals();
  renew_clusters(moved);
}

}  // namespace edgewise

// Changes of a scene by the interfaces for C and Python. They throw std::invalid_argument before they change
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "edgewise/scene.h"
#include "frontend/mesh_clusters.h"
#include "frontend/submission.h"

namespace edgewise {

inline constexpr std::uint32_t kLightGrey = rgb(200, 200, 200);  // of what has no colours

// Adds a mesh with its clusters and returns its number. If it has no colours, it is light grey.
std::size_t add_mesh(Scene& scene, Mesh mesh);
// Gives triangles of a mesh a name.
void add_part(Scene& scene, std::size_t mesh, MeshPart part);
std::size_t add_instance(Scene& scene, const Instance& instance);
void set_instance(Scene& scene, std::size_t instance, const glm::dmat4& matrix);
void remove_instance(Scene& scene, std::size_t instance);

// Calls write(positions) for the positions of a mesh, if there are so many.
template <typename Write>
void set_positions(Scene& scene, std::size_t mesh, std::size_t vertices, Write&& write) {
  check_index("mesh", mesh, scene.meshes.size());
  Mesh& moved = scene.meshes[mesh];
  check_count("vertices", vertices, moved.positions.size());
  write(moved.positions);
  renew_clusters(moved);
}

}  // namespace edgewise

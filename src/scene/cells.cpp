#include "scene/cells.h"

#include <utility>

namespace edgewise {

void join_cells(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    Mesh quads{mesh.positions, {}, {}};
    for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {
      const glm::uvec3 upper = mesh.triangles[i], lower = mesh.triangles[i + 1];
      quads.add_quad({upper.x, upper.y, lower.y, upper.z}, mesh.colours[i]);
    }
    quads.clusters = clusters_of(quads);
    mesh = std::move(quads);
  }
}

}  // namespace edgewise

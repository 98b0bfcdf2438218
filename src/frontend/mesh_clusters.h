// Clusters of a mesh (Mesh::clusters), which are dropped if their bounding boxes lie beyond one side of the
// view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "edgewise/scene.h"
#include "frontend/clip.h"
#include "frontend/view.h"

namespace edgewise {

inline std::size_t cluster_count(const Mesh& mesh) {
  return (mesh.triangles.size() + kClusterTriangles - 1) / kClusterTriangles;
}

// The clusters of a mesh of any size, all of whose vertices must exist.
std::vector<MeshCluster> make_clusters(const Mesh& mesh);
// Makes the boxes of a mesh that has clusters anew, after a change of positions.
void renew_clusters(Mesh& mesh);
// Sets the clusters of every mesh of a scene, whatever its size. For `verify --random` and fuzzing.
void make_clusters(Drawable& drawable);

// The six sides of the view, in a mesh's model space.
class ViewSides {
 public:
  ViewSides(const ScreenTransform& to_screen, const ViewVolume& view);
  // True only if all vertices in the box are beyond one side, and transform.cpp, which rounds to floats,
  // finds them there too. False for a box that is not finite.
  bool exclude(const MeshCluster& box) const;

 private:
  // With v = (position - origin, 1), a vertex is beyond the side if plane · v < 0. The rounding errors of
  // transform.cpp are less than the product of `error` and v's absolute coordinates.
  struct Side {
    glm::dvec4 plane, error;
  };
  glm::dvec3 origin_;
  Side sides_[6];
};

}  // namespace edgewise

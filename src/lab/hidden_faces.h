// Drops hidden faces before projection, as the engines of many tutorials do: applies a facing test of the
// laboratory to each face and returns a scene of the faces that remain.
#pragma once

#include <cstdint>
#include <vector>

#include "edgewise/scene.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

class HiddenFaces {
 public:
  // Throws std::invalid_argument for a method that needs more than the view direction (by_direction is
  // false), and std::out_of_range for an instance whose mesh the scene lacks.
  HiddenFaces(const Scene& scene, const FacingMethod& method);

  // `scene` must be the constructor's, but the camera and the instances may have moved. Tests each face of
  // each instance once, on the calling thread. Keeps two-sided faces, and the
  // order of the faces. Instances must have an invertible matrix. Allocates nothing; the result is valid
  // until the next call.
  const Drawable& drop(const Scene& scene);
  const FacingMethod& method() const { return *method_; }

 private:
  // In the mesh's own space: drop() transforms the view direction, not the vertices.
  struct Faces {
    FacingScene scene;                   // a face's positions are those of its first triangle
    std::vector<std::size_t> triangles;  // of each face
    std::vector<std::uint8_t> front;
  };
  const FacingMethod* method_;
  std::vector<Faces> faces_;  // one per mesh
  Drawable left_;             // a scene with one mesh per instance
};

}  // namespace edgewise::lab

// Finds the triangle of a scene that an id of the front end stands for.
#pragma once

#include <cstdint>

#include "edgewise/scene.h"

namespace edgewise::lab {

class SourceTriangles {
 public:
  explicit SourceTriangles(const Scene& scene) : scene_(scene) {}  // the scene must outlive it

  struct Source {
    const Instance& instance;
    const Mesh& mesh;
    std::size_t triangle;  // index into the mesh
  };
  // Ids must be requested in ascending order, the front end's order.
  Source at(std::uint32_t id) {
    while (id - first_ >= mesh().triangles.size()) first_ += mesh().triangles.size(), ++instance_;
    return {scene_.instances[instance_], mesh(), id - first_};
  }

 private:
  const Mesh& mesh() const { return scene_.meshes[scene_.instances.at(instance_).mesh]; }

  const Scene& scene_;
  std::size_t instance_ = 0, first_ = 0;
};

}  // namespace edgewise::lab

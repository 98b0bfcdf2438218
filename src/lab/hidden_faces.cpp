#include "lab/hidden_faces.h"

#include <stdexcept>
#include <utility>

#include "frontend/view.h"
#include "lab/view_space.h"

namespace edgewise::lab {

namespace {

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t begin, std::size_t end) {
  if (from.empty()) return;  // a mesh without flags or normals
  const auto at = [&](std::size_t i) { return from.begin() + static_cast<std::ptrdiff_t>(i); };
  to.insert(to.end(), at(begin), at(end));
}

void append(Mesh& to, const Mesh& from, std::size_t begin, std::size_t end) {
  append(to.triangles, from.triangles, begin, end);
  append(to.colours, from.colours, begin, end);
  append(to.flags, from.flags, begin, end);
  append(to.normals, from.normals, begin, end);
}

}  // namespace

HiddenFaces::HiddenFaces(const Scene& scene, const FacingMethod& method) : method_(&method) {
  if (!method.by_direction)
    throw std::invalid_argument(std::string(method.info.name) +
                                " needs the camera's position, not only its direction");
  for (const Mesh& mesh : scene.meshes) {
    Faces& faces = faces_.emplace_back();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (i > 0 && mesh.has_flag(i, kSameFace)) {
        ++faces.triangles.back();
        continue;
      }
      auto& positions = faces.scene.positions;
      for (int k = 0; k < 3; ++k) positions.push_back(mesh.positions.at(mesh.triangles[i][k]));
      faces.scene.faces.push_back({static_cast<std::uint32_t>(positions.size() - 3), 3, mesh.normal_of(i)});
      faces.triangles.push_back(1);
    }
    faces.front.resize(faces.triangles.size());
  }
  Scene left = scene;
  left.meshes.clear();
  for (Instance& instance : left.instances)
    left.meshes.push_back(scene.meshes.at(std::exchange(instance.mesh, left.meshes.size())));
  left_ = std::move(left);
}

const Drawable& HiddenFaces::drop(const Scene& scene) {
  Scene& left = std::get<Scene>(left_);
  left.camera = camera_of(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    left.instances[i] = instance;
    left.instances[i].mesh = i;
    Faces& faces = faces_[instance.mesh];
    faces.scene.view.forward =
        in_mesh_space(glm::dmat3(model_matrix(mesh, instance)), line_of_sight(scene.camera));
    method_->classify(faces.scene, faces.front);

    Mesh& kept = left.meshes[i];
    kept.triangles.clear(), kept.colours.clear(), kept.flags.clear(), kept.normals.clear();
    kept.clusters.clear();
    std::size_t begin = 0, end = 0;  // a run of consecutive kept triangles
    for (std::size_t face = 0; face < faces.front.size(); ++face) {
      const std::size_t first = end;
      end += faces.triangles[face];
      if (faces.front[face] != 0 || mesh.has_flag(first, kTwoSided)) continue;
      append(kept, mesh, begin, first);
      begin = end;
    }
    append(kept, mesh, begin, end);
  }
  return left_;
}

}  // namespace edgewise::lab

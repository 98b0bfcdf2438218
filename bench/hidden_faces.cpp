#include "hidden_faces.h"

#include <utility>

#include "viewer/world.h"

namespace edgewise::bench {

namespace {

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t begin, std::size_t end) {
  if (from.empty()) return;  // marks
  const auto at = [&](std::size_t i) { return from.begin() + static_cast<std::ptrdiff_t>(i); };
  to.insert(to.end(), at(begin), at(end));
}

void append(Mesh& to, const Mesh& from, std::size_t begin, std::size_t end) {
  append(to.triangles, from.triangles, begin, end);
  append(to.colours, from.colours, begin, end);
  append(to.marks, from.marks, begin, end);
}

}  // namespace

HiddenFaces::HiddenFaces(Scene scene, const lab::FacingMethod& method)
    : all_(std::move(scene)), method_(method) {
  for (const Mesh& mesh : all_.meshes) {
    Faces& faces = faces_.emplace_back();
    auto& positions = faces.scene.positions;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3 corners = mesh.triangles[i];
      if (mesh.has_mark(i, kSecondHalf) && i > 0) {
        positions.push_back(mesh.positions.at(corners.z));
        ++faces.scene.faces.back().count;
        continue;
      }
      faces.scene.faces.push_back({static_cast<std::uint32_t>(positions.size()), 3});
      for (int k = 0; k < 3; ++k) positions.push_back(mesh.positions.at(corners[k]));
    }
    faces.front.resize(faces.scene.faces.size());
  }
  Scene left = all_;
  left.meshes.clear();
  for (Instance& instance : left.instances)
    left.meshes.push_back(all_.meshes.at(std::exchange(instance.mesh, left.meshes.size())));
  left_ = std::move(left);
}

// The normal of a face that M moves is det M · M^-T · n, so its product with the line of sight d is n times
// det M · M^-1 · d, whatever M scales or mirrors.
void HiddenFaces::look_at(const Instance& instance, lab::FacingView& view) const {
  const glm::dmat3 model(model_matrix(instance));
  const glm::dvec3 sight(viewer::line_of_sight(all_.camera));
  view.forward = glm::vec3(glm::normalize(glm::determinant(model) * (glm::inverse(model) * sight)));
}

const Drawable& HiddenFaces::drop() {
  Scene& left = std::get<Scene>(left_);
  for (std::size_t i = 0; i < all_.instances.size(); ++i) {
    const Instance& instance = all_.instances[i];
    const Mesh& mesh = all_.meshes[instance.mesh];
    Faces& faces = faces_[instance.mesh];
    look_at(instance, faces.scene.view);
    method_.classify(faces.scene, faces.front);

    Mesh& kept = left.meshes[i];
    kept.triangles.clear(), kept.colours.clear(), kept.marks.clear();
    std::size_t begin = 0, end = 0;  // of the triangles that are kept in a row
    for (std::size_t face = 0; face < faces.front.size(); ++face) {
      const std::size_t first = end;
      end += faces.scene.faces[face].count - 2;
      if (faces.front[face] != 0 || mesh.has_mark(first, kTwoSided)) continue;
      append(kept, mesh, begin, first);
      begin = end;
    }
    append(kept, mesh, begin, end);
  }
  return left_;
}

}  // namespace edgewise::bench

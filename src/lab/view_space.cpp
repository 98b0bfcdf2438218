#include "lab/view_space.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace edgewise::lab {

namespace {

template <typename Place>
ClippingScene as_one_mesh(const Scene& scene, Size size, const Place& place) {
  ClippingScene seen{{}, size};
  seen.scene.meshes.resize(1);
  seen.scene.instances.resize(1);
  seen.scene.camera = scene.camera;
  Mesh& all = seen.scene.meshes.front();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(instance);
    for (const glm::uvec3 triangle : mesh.triangles) {
      const auto first = static_cast<unsigned>(all.positions.size());
      for (int k = 0; k < 3; ++k)
        all.positions.emplace_back(
            place(glm::dmat3(model) * glm::dvec3(mesh.positions.at(triangle[k])), glm::dvec3(model[3])));
      all.triangles.emplace_back(first, first + 1, first + 2);
    }
    all.colours.insert(all.colours.end(), mesh.colours.begin(), mesh.colours.end());
  }
  return seen;
}

}  // namespace

ClippingScene in_world_space(const Scene& scene, Size size) {
  return as_one_mesh(scene, size, [](glm::dvec3 turned, glm::dvec3 offset) { return turned + offset; });
}

ClippingScene in_view_space(const Scene& scene, Size size) {
  const glm::dmat3 turn = to_camera_frame(scene.camera);
  ClippingScene seen = as_one_mesh(scene, size, [&](glm::dvec3 turned, glm::dvec3 offset) {
    return turn * (turned + (offset - scene.camera.position));
  });
  seen.scene.camera.position = glm::dvec3(0.0);
  seen.scene.camera.yaw = seen.scene.camera.pitch = 0.0f;
  return seen;
}

std::vector<std::uint8_t> fronts_of(const FacingMethod& method, const ClippingScene& seen) {
  const float half_height_px = static_cast<float>(seen.size.height) * 0.5f;
  FacingScene scene;
  scene.view.down = {0.0f, -1.0f, 0.0f};
  scene.view.forward = {0.0f, 0.0f, -1.0f};
  scene.view.focal_px = half_height_px / std::tan(seen.scene.camera.fov_y * 0.5f);
  scene.view.size = seen.size;
  scene.positions = seen.mesh().positions;
  for (std::uint32_t i = 0; i < seen.mesh().triangles.size(); ++i) scene.faces.push_back({3 * i, 3});
  std::vector<std::uint8_t> fronts(scene.faces.size());
  method.classify(scene, fronts);
  return fronts;
}

glm::dmat3 to_camera_frame(const Camera& camera) {
  glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), -double{camera.pitch}, glm::dvec3(1, 0, 0));
  turn = glm::rotate(turn, -double{camera.yaw}, glm::dvec3(0, 1, 0));
  return glm::dmat3(turn);
}

glm::vec3 line_of_sight(const Camera& camera) {
  return glm::vec3(glm::transpose(to_camera_frame(camera)) * glm::dvec3(0, 0, -1));
}

}  // namespace edgewise::lab

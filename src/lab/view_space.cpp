#include "lab/view_space.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "core/trigonometry.h"
#include "frontend/shade.h"
#include "frontend/view.h"
#include "scene/origin.h"

namespace edgewise::lab {

namespace {

ClippingScene as_one_mesh(const Scene& scene, Size size, const glm::dmat3& turn, glm::dvec3 eye) {
  ClippingScene seen{{}, size};
  seen.scene.meshes.resize(1);
  seen.scene.instances.resize(1);
  seen.scene.camera = camera_of(scene);
  Mesh& all = seen.scene.meshes.front();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    const glm::dmat3 turn_normal = turn * cofactor_matrix(model);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3 triangle = mesh.triangles[i];
      const auto first = static_cast<unsigned>(all.positions.size());
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 turned = glm::dmat3(model) * glm::dvec3(mesh.positions.at(triangle[k]));
        all.positions.emplace_back(turn * (turned + (glm::dvec3(model[3]) - eye)));
      }
      all.triangles.emplace_back(first, first + 1, first + 2);
      const glm::dvec3 normal = turn_normal * glm::dvec3(mesh.normal_of(i));
      all.normals.emplace_back(normal == glm::dvec3(0.0) ? normal : glm::normalize(normal));
      all.flags.push_back(mesh.flags.empty() ? std::uint8_t{0} : mesh.flags[i]);
    }
    all.colours.insert(all.colours.end(), mesh.colours.begin(), mesh.colours.end());
  }
  return seen;
}

}  // namespace

ClippingScene in_world_space(const Scene& scene, Size size) {
  return as_one_mesh(scene, size, glm::dmat3(1.0), glm::dvec3(0.0));
}

ClippingScene in_view_space(const Scene& scene, Size size) {
  ClippingScene seen = as_one_mesh(scene, size, to_camera_frame(scene.camera), scene.camera.position);
  seen.scene.camera.position = glm::dvec3(0.0);
  seen.scene.camera.yaw = seen.scene.camera.pitch = 0.0f;
  return seen;
}

std::vector<std::uint8_t> fronts_of(const FacingMethod& method, const ClippingScene& seen) {
  const float half_height_px = static_cast<float>(seen.size.height) * 0.5f;
  FacingScene scene;
  scene.view.down = {0.0f, -1.0f, 0.0f};
  scene.view.forward = {0.0f, 0.0f, -1.0f};
  scene.view.focal_px = half_height_px / tangent(seen.scene.camera.fov_y * 0.5f);
  scene.view.size = seen.size;
  scene.positions = seen.mesh().positions;
  for (std::uint32_t i = 0; i < seen.mesh().triangles.size(); ++i)
    scene.faces.push_back({3 * i, 3, seen.mesh().normals[i]});
  std::vector<std::uint8_t> fronts(scene.faces.size());
  method.classify(scene, fronts);
  for (std::size_t i = 1; method.by_normal && i < fronts.size(); ++i)
    if (seen.mesh().has_flag(i, kSameFace)) fronts[i] = fronts[i - 1];
  return fronts;
}

Drawable with_camera(const Drawable& drawable, Size size) {
  const auto* const scene = std::get_if<Scene>(&drawable);
  if (scene == nullptr || !scene->matrices) return drawable;
  const View view(*scene, size.width, size.height);
  if (view.has_z)
    throw std::invalid_argument("this needs an affine view and a perspective projection (camera.h)");
  constexpr double kFarthest = 1e30;  // in place of infinity
  Scene seen = *scene;
  fold_origins(seen);
  seen.matrices.reset();
  seen.camera = {.fov_y = std::numbers::pi_v<float> / 2.0f,
                 .near_z = static_cast<float>(view.volume.near_z),
                 .far_z = static_cast<float>(std::min(view.volume.far_z, kFarthest))};
  const glm::dmat3 to_camera = glm::inverse(pixels_of(seen.camera, size.width, size.height)) * view.pixels;
  for (Instance& instance : seen.instances) {
    const glm::dmat4 model = model_matrix(seen.meshes[instance.mesh], instance);
    instance.matrix.emplace(to_camera * glm::dmat3(model));
    (*instance.matrix)[3] = glm::dvec4(to_camera * (glm::dvec3(model[3]) - view.origin), 1.0);
  }
  return seen;
}

glm::vec3 line_of_sight(const Camera& camera) {
  return glm::vec3(glm::transpose(to_camera_frame(camera)) * glm::dvec3(0, 0, -1));
}

// A matrix M maps a face's normal n to det M · M^-T · n, so its product with d is n · (det M · M^-1 · d).
glm::vec3 in_mesh_space(const glm::dmat3& model, glm::dvec3 direction) {
  return glm::vec3(glm::normalize(glm::determinant(model) * (glm::inverse(model) * direction)));
}

}  // namespace edgewise::lab

// The sphere of the projection scenes and sweeps.
#include <numbers>

#include "core/trigonometry.h"
#include "lab/projection/projection.h"

namespace edgewise::lab {

Scene sphere_scene(unsigned rings, unsigned segments) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (unsigned ring = 0; ring <= rings; ++ring)
    for (unsigned segment = 0; segment <= segments; ++segment) {
      const double v = std::numbers::pi * ring / rings, u = 2 * std::numbers::pi * segment / segments;
      mesh.positions.emplace_back(cosine(u) * sine(v), cosine(v), sine(u) * sine(v));
    }
  for (unsigned ring = 0; ring < rings; ++ring)
    for (unsigned segment = 0; segment < segments; ++segment) {
      const unsigned a = ring * (segments + 1) + segment, c = a + segments + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, c}, {a + 1, c + 1, c}});
    }
  mesh.colours.assign(mesh.triangles.size(), rgb(200, 200, 200));
  scene.instances.resize(1);
  scene.camera = {.position = {0.37, 0.61, 2.7}, .yaw = 0.13f, .pitch = -0.21f, .fov_y = 0.8f};
  return scene;
}

Scene sphere_far_from_origin(double away) {
  Scene scene = sphere_scene(64, 96);
  for (glm::vec3& p : scene.meshes.front().positions) p += glm::vec3(static_cast<float>(away));
  scene.camera.position += away;
  return scene;
}

Scene sphere_far_from_camera(double distance) {
  Scene scene = sphere_scene(64, 96);
  scene.camera.position *= distance / glm::length(scene.camera.position);
  scene.camera.look_at({0.0, 0.0, 0.0});
  scene.camera.fov_y = static_cast<float>(2 * arctangent(1.25, distance));
  scene.camera.near_z = static_cast<float>(distance / 2),
  scene.camera.far_z = static_cast<float>(2 * distance);
  return scene;
}

}  // namespace edgewise::lab

// Clipping sweeps: the distance of the near plane, the distance of a vertex from the camera's plane, and that
// of camera and scene from the origin.
#include "core/random.h"
#include "core/trigonometry.h"
#include "lab/clipping/clipping.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

namespace {

constexpr Size kSize{128, 96};

Measured measure_scene(const ClippingScene& scene) {
  const ClippingTruth truth = clipping_truth(scene);
  return measured(clipping_methods(), [&](const ClippingMethod& method) {
    const ClippingScore s = score(method, scene, truth);
    return Tally{s.wrong(), s.covered};
  });
}

// The camera looks elsewhere for each seed.
Measured measure_turned(ClippingScene scene, std::uint64_t seed) {
  scene.size = kSize;
  Random random(seed);
  scene.scene.camera.yaw += random.uniform(-0.1f, 0.1f);
  scene.scene.camera.pitch += random.uniform(-0.1f, 0.1f);
  return measure_scene(scene);
}

// Triangles as a floor and a wall beside the camera, each with one vertex at distance w from the camera's
// plane.
Measured measure_vertex_w(double w, std::uint64_t seed) {
  ClippingScene s{{}, kSize};
  Mesh& mesh = s.scene.meshes.emplace_back();
  s.scene.instances.emplace_back();
  s.scene.camera.fov_y = static_cast<float>(2 * arctangent(1, 2));
  s.scene.camera.near_z = 0.1f;
  s.scene.camera.far_z = 50.0f;
  const auto z = static_cast<float>(-w);
  mesh.positions = {{-4, -1, -12}, {4, -1, -12}, {0.3f, -1, z}, {-2, 3, -12}, {-1, -0.8f, z}, {-2, -3, -12}};
  Random random(seed);
  for (glm::vec3& position : mesh.positions)
    position.x += random.uniform(-0.2f, 0.2f), position.y += random.uniform(-0.2f, 0.2f);
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.colours = {rgb(200, 0, 0), rgb(0, 200, 0)};
  return measure_scene(s);
}

}  // namespace

std::vector<Sweep> clipping_sweeps() {
  return {
      {"near_plane",
       Family::clipping,
       "a floor under the camera, through a wall at 10: depths get too coarse",
       {"near plane's distance", ""},
       decades(1, -6),
       [](double near_z, std::uint64_t seed) {
         return measure_turned(floor_through_eye(static_cast<float>(near_z)), seed);
       },
       "31 bits of depth err by up to 34 units: z^2 / (2^26 near) at a distance z"},
      {"vertex_w",
       Family::clipping,
       "a floor and a wall with a vertex near the camera's plane; near 0.1",
       {"w of the vertex", ""},
       decades(1, -6),
       measure_vertex_w},
      {"origin",
       Family::clipping,
       "a tiled floor under the camera, both far from the origin; near 1/1024",
       {"distance from origin", ""},
       decades(0, 8),
       [](double away, std::uint64_t seed) { return measure_turned(floor_far_from_origin(away), seed); }}};
}

}  // namespace edgewise::lab

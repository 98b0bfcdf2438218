// The camera looks at the centre of the bounding box, from far enough away that the cone of its field of view
// contains all vertices.
#include <algorithm>
#include <cmath>
#include <limits>

#include "edgewise/scene.h"

namespace edgewise {

namespace {

constexpr float kFovY = 0.785398163f;  // 45 degrees
constexpr double kMargin = 1.05;       // factor on the radius of the sphere around all vertices

template <typename Visit>
void for_each_vertex(const Scene& scene, const Visit& visit) {
  for (const Instance& instance : scene.instances) {
    const glm::dmat4 model(model_matrix(instance));
    for (const glm::vec3& position : scene.meshes.at(instance.mesh).positions) {
      const glm::dvec3 world(model * glm::dvec4(position, 1.0));
      if (std::isfinite(world.x) && std::isfinite(world.y) && std::isfinite(world.z)) visit(world);
    }
  }
}

}  // namespace

void frame_camera(Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for_each_vertex(scene, [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  const glm::dvec3 centre = low.x <= high.x ? (low + high) * 0.5 : glm::dvec3(0.0);
  double radius = 0.0;
  for_each_vertex(scene, [&](const glm::dvec3& p) { radius = std::max(radius, glm::distance(centre, p)); });
  if (radius == 0.0) radius = 1.0;

  const double distance = kMargin * radius / std::sin(0.5 * double{kFovY});
  Camera& camera = scene.camera;
  camera.position = glm::vec3(centre + distance * glm::normalize(glm::dvec3(0.4, 0.35, 1.0)));
  camera.fov_y = kFovY;
  // All vertices are between 0.5 and 1.5 times this distance away.
  camera.near_z = static_cast<float>(distance / 100.0);
  camera.far_z = static_cast<float>(distance * 4.0);
  camera.look_at(glm::vec3(centre));
}

}  // namespace edgewise

// Where a scene lies, and a camera that sees all of it. In double: a scene may lie far from the origin.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/finite.h"
#include "core/float_state.h"
#include "core/trigonometry.h"
#include "edgewise/scene.h"
#include "scene/origin.h"

namespace edgewise {

namespace {

constexpr float kFovY = 0.785398163f;  // 45 degrees
constexpr double kMargin = 1.05;       // factor on the radius of the sphere around all vertices

// Visits the vertices that triangles name, so that no stray one counts.
template <typename Visit>
void for_each_corner(const Scene& scene, const Visit& visit) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    const glm::dmat4 model = model_matrix(mesh, instance);
    for (const glm::uvec3& triangle : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        if (triangle[k] >= mesh.positions.size()) continue;  // Frontend::run() reports it
        const glm::dvec3 world(model * glm::dvec4(mesh.positions[triangle[k]], 1.0));
        if (is_finite(world)) visit(world);
      }
  }
}

}  // namespace

Bounds bounds_of(const Scene& scene) {
  const DefaultFloatState state;
  Bounds box = no_box();
  for_each_corner(scene, [&](const glm::dvec3& p) { extend(box, p); });
  return box;
}

void frame_camera(Scene& scene, double aspect) {
  const DefaultFloatState state;
  const auto [low, high] = bounds_of(scene);
  const glm::dvec3 centre = low.x <= high.x ? low + 0.5 * (high - low) : glm::dvec3(0.0);
  double radius = 0.0;
  for_each_corner(scene, [&](const glm::dvec3& p) { radius = std::max(radius, glm::distance(centre, p)); });
  if (radius == 0.0) radius = 1.0;

  // Of half the angle of the narrower side. The sphere touches the side of the view: distance = radius /
  // sine.
  const double tan = tangent(0.5 * double{kFovY}) * std::min(aspect, 1.0);
  const double distance = kMargin * radius * std::sqrt(1.0 + tan * tan) / tan;
  scene.matrices.reset();
  Camera& camera = scene.camera;
  camera.position = centre + distance * glm::normalize(glm::dvec3(0.4, 0.35, 1.0));
  camera.fov_y = kFovY;
  // All vertices are between 0.5 and 1.5 times this distance away.
  camera.near_z = static_cast<float>(distance / 100.0);
  camera.far_z = static_cast<float>(distance * 4.0);
  camera.look_at(centre);
}

void fit(Scene& scene) {
  const DefaultFloatState state;
  const auto [low, high] = bounds_of(scene);
  const glm::dvec3 size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0.0)) return;
  const double factor = 2.0 / longest;
  const glm::dvec3 centre = low + 0.5 * size, moved = glm::abs(centre * factor);
  // Beyond the first two, products with the camera's matrix may leave the range of float. Beyond the third,
  // doubles round the moved vertices by over 2^-17.
  if (!(factor >= 0x1p-126 && factor <= 0x1p100 && std::max({moved.x, moved.y, moved.z}) <= 0x1p36))
    throw std::invalid_argument(
        "too small, too large, or too far from the origin to be scaled to a size of 2");
  fold_origins(scene);  // now: the sum of a moved instance and a distant origin would round the shape away
  for (auto& instance : scene.instances) {
    if (instance.matrix) {
      for (int i = 0; i < 4; ++i) {
        glm::dvec4& column = (*instance.matrix)[i];
        column = glm::dvec4((glm::dvec3(column) - column.w * centre) * factor, column.w);
      }
    } else {
      instance.scale *= factor;
      instance.translation = (instance.translation - centre) * factor;
    }
  }
}

}  // namespace edgewise

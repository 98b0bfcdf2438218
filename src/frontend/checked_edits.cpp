#include "frontend/checked_edits.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "frontend/view.h"

namespace edgewise {

std::size_t add_mesh(Scene& scene, Mesh mesh) {
  check_vertices(mesh);
  if (mesh.colours.empty()) mesh.colours.assign(mesh.triangles.size(), kLightGrey);
  mesh.clusters = clusters_of(mesh);
  scene.meshes.push_back(std::move(mesh));
  return scene.meshes.size() - 1;
}

void add_part(Scene& scene, std::size_t mesh, MeshPart part) {
  check_index("mesh", mesh, scene.meshes.size());
  check_part(scene.meshes[mesh], part);
  scene.meshes[mesh].parts.push_back(std::move(part));
}

std::size_t add_instance(Scene& scene, const Instance& instance) {
  check_index("mesh", instance.mesh, scene.meshes.size());
  check(instance);
  scene.instances.push_back(instance);
  return scene.instances.size() - 1;
}

void set_instance(Scene& scene, std::size_t instance, const glm::dmat4& matrix) {
  check_index("instance", instance, scene.instances.size());
  check(Instance{.matrix = matrix});
  scene.instances[instance].matrix = matrix;
}

void remove_instance(Scene& scene, std::size_t instance) {
  check_index("instance", instance, scene.instances.size());
  scene.instances.erase(scene.instances.begin() + static_cast<std::ptrdiff_t>(instance));
}

glm::vec3 checked_light(const glm::dvec3& towards) {
  const double largest = std::max({std::abs(towards.x), std::abs(towards.y), std::abs(towards.z)});
  if (!(largest > 0.0 && std::isfinite(glm::dot(towards / largest, glm::dvec3(1.0)))))
    throw std::invalid_argument("the direction towards the light must be finite and not 0");
  return towards / largest;
}

double checked_aspect(double aspect) {
  if (!(aspect > 0.0 && std::isfinite(aspect)))
    throw std::invalid_argument("aspect must be finite and above 0");
  return aspect;
}

}  // namespace edgewise

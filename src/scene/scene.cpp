#include "edgewise/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>

#include "core/finite.h"

namespace edgewise {

namespace {

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

}  // namespace

glm::vec3 face_normal(std::span<const glm::vec3> vertices) {
  glm::dvec3 sum(0.0);
  const glm::dvec3 first(vertices[0]);
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
    sum += glm::cross(glm::dvec3(vertices[i + 1]) - first, glm::dvec3(vertices[i]) - first);
  return sum == glm::dvec3(0.0) ? glm::vec3(0.0f) : glm::vec3(glm::normalize(sum));
}

glm::vec3 Mesh::normal_of(std::size_t triangle) const {
  return normals.empty() ? face_normal(corners_of(*this, triangle)) : normals[triangle];
}

void Mesh::fill_normals(std::size_t end) {
  for (std::size_t i = normals.size(); i < end; ++i) normals.push_back(face_normal(corners_of(*this, i)));
}

void Mesh::add_quad(glm::uvec4 corners, std::uint32_t colour, bool two_sided) {
  const std::uint8_t sides = two_sided ? kTwoSided : 0;
  fill_normals(triangles.size());
  const std::array outline{positions[corners.x], positions[corners.y], positions[corners.z],
                           positions[corners.w]};
  normals.insert(normals.end(), 2, face_normal(outline));
  flags.resize(triangles.size());
  flags.insert(flags.end(), {sides, static_cast<std::uint8_t>(sides | kSameFace)});
  triangles.emplace_back(corners.x, corners.y, corners.z);
  triangles.emplace_back(corners.x, corners.z, corners.w);
  colours.insert(colours.end(), 2, colour);
}

void Camera::look_at(glm::vec3 target) {
  const glm::dvec3 d = glm::dvec3(target) - glm::dvec3(position);
  if (d == glm::dvec3(0.0)) return;
  yaw = static_cast<float>(std::atan2(-d.x, -d.z));
  pitch = static_cast<float>(std::atan2(d.y, std::hypot(d.x, d.z)));
}

glm::mat4 model_matrix(const Instance& instance) {
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(instance.translation));
  const glm::dvec3 axis(instance.axis);
  if (instance.angle != 0.0f && axis != glm::dvec3(0.0))
    m = glm::rotate(m, static_cast<double>(instance.angle), glm::normalize(axis));
  return glm::mat4(glm::scale(m, glm::dvec3(instance.scale)));
}

void fit(Scene& scene) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  for (const auto& instance : scene.instances) {
    const glm::mat4 model = model_matrix(instance);
    for (const auto& position : scene.meshes.at(instance.mesh).positions) {
      const glm::vec3 p(model * glm::vec4(position, 1.0f));
      if (!is_finite(p)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const glm::vec3 size = high - low;
  const float longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0.0f)) return;
  const float factor = 2.0f / longest;
  const glm::vec3 centre = low + 0.5f * size, moved = centre * factor;
  // Beyond this, products with the camera's matrix may overflow.
  constexpr float kLargest = 0x1p100f;
  if (!(factor > 0.0f &&
        std::max({factor, std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}) <= kLargest))
    throw std::invalid_argument(
        "too small, too large, or too far from the origin to be scaled to a size of 2");
  for (auto& instance : scene.instances) {
    instance.scale *= factor;
    instance.translation = (instance.translation - centre) * factor;
  }
}

}  // namespace edgewise

#include "edgewise/scene.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "core/float_state.h"
#include "core/trigonometry.h"

namespace edgewise {

namespace {

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

}  // namespace

glm::vec3 face_normal(std::span<const glm::vec3> vertices) {
  const DefaultFloatState state;
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

glm::dmat4 model_matrix(const Instance& instance) {
  const DefaultFloatState state;
  if (instance.matrix) return *instance.matrix;
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), instance.translation);
  if (instance.angle != 0.0f && instance.axis != glm::vec3(0.0f))
    m *= glm::dmat4(rotation(instance.axis, double{instance.angle}));
  return glm::scale(m, instance.scale);
}

}  // namespace edgewise

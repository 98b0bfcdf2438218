#include "edgewise/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "core/finite.h"
#include "core/float_state.h"
#include "core/trigonometry.h"
#include "scene/origin.h"

namespace edgewise {

namespace {

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

// Twice the area vector of a face.
glm::dvec3 area_vector(std::span<const glm::vec3> vertices) {
  glm::dvec3 sum(0.0);
  const glm::dvec3 first(vertices[0]);
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
    sum += glm::cross(glm::dvec3(vertices[i + 1]) - first, glm::dvec3(vertices[i]) - first);
  return sum;
}

glm::vec3 direction_of(const glm::dvec3& v) {
  return v == glm::dvec3(0.0) ? glm::vec3(0.0f) : glm::vec3(glm::normalize(v));
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

glm::dmat4 matrix_of(const Instance& instance) {
  if (instance.matrix) return *instance.matrix;
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), instance.translation);
  if (instance.angle != 0.0f && instance.axis != glm::vec3(0.0f))
    m *= glm::dmat4(rotation(instance.axis, double{instance.angle}));
  return glm::scale(m, instance.scale);
}

}  // namespace

glm::vec3 face_normal(std::span<const glm::vec3> vertices) {
  const DefaultFloatState state;
  return direction_of(area_vector(vertices));
}

bool is_far(const Bounds& box) {
  constexpr double kFar = 4.0;
  return largest(glm::max(glm::abs(box.low), glm::abs(box.high))) > kFar * largest(box.high - box.low);
}

glm::dvec3 rounded_centre(const Bounds& box) {
  const double longest = largest(box.high - box.low);
  const double step = longest > 0.0 ? std::ldexp(1.0, std::ilogb(longest)) : 1.0;
  return glm::round((box.low + box.high) * (0.5 / step)) * step;
}

void fold_origins(Scene& scene) {
  for (Instance& instance : scene.instances) {
    const glm::dvec4 at = model_matrix(scene.meshes.at(instance.mesh), instance)[3];
    if (instance.matrix)
      (*instance.matrix)[3] = at;
    else
      instance.translation = glm::dvec3(at);
  }
  for (Mesh& mesh : scene.meshes) mesh.origin = glm::dvec3(0.0);
}

void Mesh::set_positions(std::span<const glm::dvec3> points) {
  const DefaultFloatState state;
  Bounds box = no_box();
  bool are_floats = true;
  const auto add = [&](std::size_t i) {
    const glm::vec3 rounded(points[i]);
    if (!is_finite(rounded)) return;
    are_floats = are_floats && glm::dvec3(rounded) == points[i];
    extend(box, points[i]);
  };
  for (std::size_t i = 0; triangles.empty() && i < points.size(); ++i) add(i);
  for (const glm::uvec3& triangle : triangles)
    for (int k = 0; k < 3; ++k)
      if (triangle[k] < points.size()) add(triangle[k]);
  const glm::dvec3 from = are_floats || !is_far(box) ? glm::dvec3(0.0) : rounded_centre(box);
  std::vector<glm::vec3> made;
  made.reserve(points.size());
  for (const glm::dvec3& point : points) made.emplace_back(point - from);
  positions = std::move(made), origin = from;
}

void Mesh::renew_normals() {
  const DefaultFloatState state;
  for (std::size_t begin = 0, end = 0; begin < normals.size(); begin = end) {
    glm::dvec3 sum(0.0);
    do sum += area_vector(corners_of(*this, end));
    while (++end < normals.size() && has_flag(end, kSameFace));
    std::fill_n(&normals[begin], end - begin, direction_of(sum));
  }
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

glm::dmat4 model_matrix(const Mesh& mesh, const Instance& instance) {
  const DefaultFloatState state;
  const glm::dmat4 m = matrix_of(instance);
  return mesh.origin == glm::dvec3(0.0) ? m : glm::translate(m, mesh.origin);
}

}  // namespace edgewise

#include "edgewise/scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace edgewise {

void Mesh::add_quad(glm::uvec4 corners, std::uint32_t colour, bool two_sided) {
  const std::uint8_t sides = two_sided ? kTwoSided : 0;
  flags.resize(triangles.size());
  triangles.emplace_back(corners.x, corners.y, corners.z);
  triangles.emplace_back(corners.x, corners.z, corners.w);
  flags.insert(flags.end(), {sides, static_cast<std::uint8_t>(sides | kSecondHalf)});
  colours.insert(colours.end(), 2, colour);
}

void Camera::look_at(glm::dvec3 target) {
  // Adding 0 turns -0 into 0: atan2 tells them apart.
  const glm::dvec3 back = position - target + 0.0;
  if (back == glm::dvec3(0.0)) return;
  yaw = static_cast<float>(std::atan2(back.x, back.z));
  pitch = static_cast<float>(std::atan2(0.0 - back.y, std::hypot(back.x, back.z)));
}

glm::dmat4 model_matrix(const Instance& instance) {
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), instance.translation);
  const glm::dvec3 axis(instance.axis);
  if (instance.angle != 0.0f && axis != glm::dvec3(0.0))
    m = glm::rotate(m, static_cast<double>(instance.angle), glm::normalize(axis));
  return glm::scale(m, instance.scale);
}

}  // namespace edgewise

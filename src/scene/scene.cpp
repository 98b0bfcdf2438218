#include "edgewise/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>

#include "core/finite.h"

namespace edgewise {

void Mesh::add_quad(glm::uvec4 corners, std::uint32_t colour, bool two_sided) {
  const std::uint8_t sides = two_sided ? kTwoSided : 0;
  flags.resize(triangles.size());
  triangles.emplace_back(corners.x, corners.y, corners.z);
  triangles.emplace_back(corners.x, corners.z, corners.w);
  flags.insert(flags.end(), {sides, static_cast<std::uint8_t>(sides | kSecondHalf)});
  colours.insert(colours.end(), 2, colour);
}

void Camera::look_at(glm::vec3 target) {
  // Adding 0 turns -0 into 0: atan2 tells them apart.
  const glm::dvec3 back = glm::dvec3(position) - glm::dvec3(target) + 0.0;
  if (back == glm::dvec3(0.0)) return;
  yaw = static_cast<float>(std::atan2(back.x, back.z));
  pitch = static_cast<float>(std::atan2(0.0 - back.y, std::hypot(back.x, back.z)));
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

#include "frontend/view.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <stdexcept>

#include "core/finite.h"

namespace edgewise {

namespace {

void check(const Camera& camera) {
  if (!is_finite(camera.position) || !std::isfinite(camera.yaw) || !std::isfinite(camera.pitch))
    throw std::invalid_argument("the camera's position, yaw and pitch must be finite");
  if (!(camera.fov_y > 0.0f && camera.fov_y < std::numbers::pi_v<float>))
    throw std::invalid_argument("the camera's field of view must be between 0 and 180 degrees");
  if (!(camera.near_z > 0.0f && camera.near_z < camera.far_z && std::isfinite(camera.far_z)))
    throw std::invalid_argument("the camera needs 0 < near < far");
}

}  // namespace

glm::dmat4 screen_matrix(const Camera& camera, int width_px, int height_px) {
  check(camera);
  const double half_w = width_px / 2.0, half_h = height_px / 2.0;
  glm::dmat4 viewport(1.0);
  viewport[0][0] = half_w;
  viewport[1][1] = -half_h;
  viewport[3][0] = half_w;
  viewport[3][1] = half_h;
  const glm::dmat4 projection =
      glm::perspectiveRH_ZO(double{camera.fov_y}, static_cast<double>(width_px) / height_px,
                            double{camera.near_z}, double{camera.far_z});
  glm::dmat4 view = glm::rotate(glm::dmat4(1.0), -double{camera.pitch}, glm::dvec3(1, 0, 0));
  view = glm::rotate(view, -double{camera.yaw}, glm::dvec3(0, 1, 0));
  view = glm::translate(view, -glm::dvec3(camera.position));
  return viewport * projection * view;
}

}  // namespace edgewise

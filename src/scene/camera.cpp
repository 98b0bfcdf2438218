#include "edgewise/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/finite.h"
#include "core/float_state.h"
#include "core/numbers.h"
#include "core/trigonometry.h"

namespace edgewise {

namespace {

// Of a perspective projection: depth = a + b / distance.
struct DepthTerms {
  double a, b;
};
DepthTerms depth_terms(double near_z, double far_z) {
  if (!(near_z > 0.0 && near_z < far_z && std::isfinite(near_z)))
    throw std::invalid_argument("a perspective projection needs 0 < near < far, not " + number_text(near_z) +
                                " and " + number_text(far_z));
  const double a = std::isinf(far_z) ? 1.0 : far_z / (far_z - near_z);
  return {a, -a * near_z};
}

}  // namespace

void Camera::look_at(glm::dvec3 target) {
  const DefaultFloatState state;
  glm::dvec3 back = position - target;
  if (back == glm::dvec3(0.0)) return;
  back /= std::max({std::abs(back.x), std::abs(back.y), std::abs(back.z)});  // so that squares stay in range
  yaw = static_cast<float>(arctangent(back.x, back.z));
  pitch = static_cast<float>(arctangent(-back.y, glm::length(glm::dvec2(back.x, back.z))));
}

glm::dmat4 perspective_projection(double fov_y, double aspect, double near_z, double far_z) {
  const DefaultFloatState state;
  const DepthTerms depth = depth_terms(near_z, far_z);
  if (!(fov_y > 0.0 && fov_y < std::numbers::pi))
    throw std::invalid_argument("a field of view must be between 0 and 180 degrees");
  if (!(aspect > 0.0 && std::isfinite(aspect)))
    throw std::invalid_argument("an image's aspect must be positive");
  const double focal = 1.0 / tangent(fov_y / 2.0);
  return {focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, -depth.a, -1, 0, 0, depth.b, 0};
}

glm::dmat4 orthographic_projection(double left, double right, double bottom, double top, double near_z,
                                   double far_z) {
  const DefaultFloatState state;
  if (!(near_z < far_z))
    throw std::invalid_argument("an orthographic projection needs near < far, not " + number_text(near_z) +
                                " and " + number_text(far_z));
  const glm::dvec3 low(left, bottom, near_z), high(right, top, far_z), size = high - low;
  if (!is_finite(low) || !is_finite(high) || !is_finite(1.0 / size))
    throw std::invalid_argument("an orthographic projection needs three finite ranges that are not empty");
  const glm::dvec3 middle = (low + high) / size;
  return {2.0 / size.x,     0, 0, 0, 0, 2.0 / size.y, 0, 0, 0, 0, -1.0 / size.z, 0, -middle.x, -middle.y,
          -near_z / size.z, 1};
}

glm::dmat4 intrinsics_projection(const glm::dmat3& k, int width, int height, double first_centre,
                                 double near_z, double far_z) {
  const DefaultFloatState state;
  const DepthTerms depth = depth_terms(near_z, far_z);
  if (width < 1 || height < 1) throw std::invalid_argument("an image has at least one pixel");
  if (!is_finite(k[0]) || !is_finite(k[1]) || !is_finite(k[2]) || !std::isfinite(first_centre))
    throw std::invalid_argument("intrinsics must be finite");
  if (k[0].z != 0.0 || k[1].z != 0.0 || k[2].z != 1.0)
    throw std::invalid_argument("the last row of intrinsics must be 0 0 1");
  const double shift = 0.5 - first_centre;
  glm::dmat4 m(0.0);
  for (int i = 0; i < 3; ++i) {
    const double w = k[i].z;
    m[i].x = 2.0 * (k[i].x + shift * w) / width - w;
    m[i].y = w - 2.0 * (k[i].y + shift * w) / height;
    m[i].w = w;
  }
  m[2].z = depth.a, m[3].z = depth.b;
  return m;
}

glm::dmat4 projection_from(ClipSpace space, const glm::dmat4& projection) {
  const DefaultFloatState state;
  glm::dmat4 m = projection;
  for (int i = 0; i < 4; ++i) {
    if (space.y_down) m[i].y = -m[i].y;
    if (space.z_from_minus_w) m[i].z = (m[i].z + m[i].w) / 2.0;
    if (space.reversed) m[i].z = m[i].w - m[i].z;
  }
  return m;
}

}  // namespace edgewise

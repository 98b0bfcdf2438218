#include "frontend/view.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/finite.h"
#include "core/trigonometry.h"

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

// The point that an instance puts at `world`. Any point near it will do: 0 stands for a coordinate that no
// point has, because the instance is flat, or that is so large that a float minus it may overflow.
glm::vec3 model_point(const glm::dmat3& axes, glm::dvec3 world) {
  const glm::dvec3 along = world * axes;  // the axes are orthogonal
  const auto coordinate = [&](int i) {
    const double at = along[i] / glm::dot(axes[i], axes[i]);
    return std::abs(at) < 0x1p103 ? static_cast<float>(at) : 0.0f;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

}  // namespace

glm::dmat3 to_camera_frame(const Camera& camera) {
  return rotation({1, 0, 0}, -double{camera.pitch}) * rotation({0, 1, 0}, -double{camera.yaw});
}

glm::dmat3 pixels_of(const Camera& camera, int width_px, int height_px) {
  const double half_w = width_px / 2.0, half_h = height_px / 2.0;
  const double focal_px = half_h / tangent(double{camera.fov_y} / 2.0);
  return glm::dmat3(focal_px, 0, 0, 0, -focal_px, 0, -half_w, -half_h, -1) * to_camera_frame(camera);
}

ViewVolume view_volume(const Camera& camera, int width_px, int height_px) {
  check(camera);
  return {double(width_px), double(height_px), double{camera.near_z}, double{camera.far_z}};
}

ScreenTransform::ScreenTransform(const Camera& camera, const Instance& instance, int width_px, int height_px)
    : ScreenTransform(pixels_of(camera, width_px, height_px), camera.position, model_matrix(instance)) {}

ScreenTransform::ScreenTransform(const glm::dmat3& pixels, glm::dvec3 eye, const glm::dmat4& model) {
  const glm::dmat3 axes(model);
  const glm::dvec3 towards = eye - glm::dvec3(model[3]);
  origin = model_point(axes, towards);
  // A vertex at such a distance is beyond usual far planes, and must not become infinite or NaN.
  constexpr double kLargest = 0x1p125, kLargestOffset = 0x1p200;
  const auto set = [&](int column, glm::dvec3 v) {
    exact[column] = pixels * v;
    rounded[column] = glm::clamp(exact[column], -kLargest, kLargest);
  };
  for (int i = 0; i < 3; ++i) set(i, axes[i]);
  set(3, glm::clamp(axes * glm::dvec3(origin) - towards, -kLargestOffset, kLargestOffset));
}

ClipVertex ScreenTransform::operator()(glm::vec3 position) const {
  const glm::dvec3 v = exact * glm::dvec4(glm::dvec3(position) - glm::dvec3(origin), 1.0);
  return {v.x, v.y, v.z, v.z};
}

glm::dmat4 screen_matrix(const Camera& camera, int width_px, int height_px) {
  const ViewVolume view = view_volume(camera, width_px, height_px);
  const glm::dmat3 pixels = pixels_of(camera, width_px, height_px);
  const double depth_scale = view.far_z / (view.far_z - view.near_z);
  const auto column = [&](glm::dvec3 v) { return glm::dvec4(v.x, v.y, depth_scale * v.z, v.z); };
  glm::dmat4 m(column(pixels[0]), column(pixels[1]), column(pixels[2]), column(pixels * -camera.position));
  m[3].z -= depth_scale * view.near_z;
  return m;
}

}  // namespace edgewise

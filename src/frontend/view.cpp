#include "frontend/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/finite.h"
#include "core/float_state.h"
#include "core/numbers.h"
#include "core/trigonometry.h"

namespace edgewise {

namespace {

void check(const Camera& camera) {
  if (!is_finite(camera.position) || !std::isfinite(camera.yaw) || !std::isfinite(camera.pitch))
    throw std::invalid_argument("the camera's position, yaw and pitch must be finite");
  if (!(camera.fov_y > 0.0f && camera.fov_y < std::numbers::pi_v<float>))
    throw std::invalid_argument("the camera's field of view must be between 0 and 180 degrees");
  if (!(camera.near_z > 0.0f && camera.near_z < camera.far_z && std::isfinite(camera.far_z)))
    throw std::invalid_argument("the camera needs 0 < near < far, not " + number_text(camera.near_z) +
                                " and " + number_text(camera.far_z));
}

bool are_orthogonal(const glm::dmat3& axes) {
  constexpr double kRounding = 0x1p-40;
  const auto meet = [&](int i, int j) {
    return std::abs(glm::dot(axes[i], axes[j])) <= kRounding * glm::length(axes[i]) * glm::length(axes[j]);
  };
  return meet(0, 1) && meet(1, 2) && meet(2, 0);
}

// The point that an instance puts at `world`. Any point near it will do: 0 stands for a coordinate that no
// point has, because the instance is flat, or that is so large that a float minus it may overflow.
glm::dvec3 model_point(const glm::dmat3& axes, glm::dvec3 world) {
  glm::dvec3 at;
  if (are_orthogonal(axes)) {
    const glm::dvec3 along = world * axes;
    for (int i = 0; i < 3; ++i) at[i] = along[i] / glm::dot(axes[i], axes[i]);
  } else {
    // Nearly dependent axes would need large coordinates, whose rounding errors do not cancel.
    constexpr double kLongest = 16.0;
    at = glm::inverse(axes) * world;
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(at[i]) * glm::length(axes[i]) <= kLongest * glm::length(world))) return glm::dvec3(0.0);
  }
  const auto coordinate = [&](int i) { return std::abs(at[i]) < 0x1p103 ? at[i] : 0.0; };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

// Clip space → x and y in pixels times w, z, and w.
glm::dmat4 viewport(int width_px, int height_px) {
  const double half_w = width_px / 2.0, half_h = height_px / 2.0;
  return {half_w, 0, 0, 0, 0, -half_h, 0, 0, 0, 0, 1, 0, half_w, half_h, 0, 1};
}

// Matrices beyond this range are beyond usual far planes too, and products must not overflow.
glm::dmat4 within_range(glm::dmat4 m) {
  for (int i = 0; i < 4; ++i) m[i] = glm::clamp(m[i], -0x1p400, 0x1p400);
  return m;
}

glm::dvec3 xyw(glm::dvec4 v) {
  return {v.x, v.y, v.w};
}

// True if the last row is 0 0 0 1.
bool is_affine(const glm::dmat4& m) {
  return m[0].w == 0.0 && m[1].w == 0.0 && m[2].w == 0.0 && m[3].w == 1.0;
}

bool is_usual_perspective(const CameraMatrices& m) {
  const glm::dmat4& p = m.projection;
  return is_affine(m.view) && xyw(p[3]) == glm::dvec3(0.0) && p[0].z == 0.0 && p[0].w == 0.0 &&
         p[1].z == 0.0 && p[1].w == 0.0;
}

// False if rounding errors decide on the determinant of a projection in which `point`, and not the world's
// origin, is the origin. Rows and columns are scaled to length 1.
bool has_inverse(glm::dmat4 to_clip, const glm::dvec3& point) {
  to_clip[3] = to_clip * glm::dvec4(point, 1.0);
  for (int i = 0; i < 2; ++i) {
    for (int column = 0; column < 4; ++column) to_clip[column] /= glm::length(to_clip[column]);
    to_clip = glm::transpose(to_clip);
  }
  return std::abs(glm::determinant(to_clip)) > 0x1p-40;
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

const Camera& camera_of(const Scene& scene) {
  if (scene.matrices) throw std::invalid_argument("this needs a camera, and the scene has matrices");
  return scene.camera;
}

void check(const Instance& instance) {
  if (instance.matrix && !(is_finite(*instance.matrix) && is_affine(*instance.matrix)))
    throw std::invalid_argument("an instance's matrix must be finite, and its last row 0 0 0 1");
}

CameraMatrices matrices_of(const Camera& camera, double aspect) {
  const DefaultFloatState state;
  check(camera);
  const glm::dmat3 turn = to_camera_frame(camera);
  glm::dmat4 view(turn);
  view[3] = glm::dvec4(turn * -camera.position, 1.0);
  return {view,
          perspective_projection(double{camera.fov_y}, aspect, double{camera.near_z}, double{camera.far_z})};
}

View::View(const Camera& camera, int width_px, int height_px, bool fine)
    : volume(view_volume(camera, width_px, height_px)),
      depth(volume.near_z, volume.far_z),
      pixels(pixels_of(camera, width_px, height_px)),
      origin(camera.position) {
  if (!fine) return;
  glm::dmat4 rows(0.0), from_origin(1.0);
  for (int i = 0; i < 3; ++i) rows[i] = glm::dvec4(pixels[i].x, pixels[i].y, 0.0, pixels[i].z);
  from_origin[3] = glm::dvec4(-origin, 1.0);
  to_pixels = PairMatrix(rows) * PairMatrix(within_range(from_origin));
}

View::View(const Scene& scene, int width_px, int height_px, bool fine)
    : View(scene.matrices ? View(*scene.matrices, width_px, height_px, fine)
                          : View(scene.camera, width_px, height_px, fine)) {}

View::View(const CameraMatrices& matrices, int width_px, int height_px, bool fine)
    : volume{double(width_px), double(height_px), 0.0, 0.0, 1.0}, depth(0.0, 1.0) {
  constexpr double kLargest = std::numeric_limits<float>::max(), kLeast = std::numeric_limits<float>::min();
  if (!is_finite(matrices.view) || !is_finite(matrices.projection))
    throw std::invalid_argument("the elements of the camera's matrices must be finite");
  const glm::dmat4 to_clip = matrices.projection * matrices.view, from_view = glm::inverse(matrices.view),
                   to_world = from_view * glm::inverse(matrices.projection);
  const char* const kSingular = "the camera's matrices have no inverse";
  if (!is_finite(to_clip) || !is_finite(to_world)) throw std::invalid_argument(kSingular);
  // Its product with (x, y, z, 1), a point after the division by w, is 1 / w. It is linear, so w is smallest
  // at a corner of the view volume.
  const glm::dvec4 inverse_w(to_world[0].w, to_world[1].w, to_world[2].w, to_world[3].w);
  const glm::dvec4 corner(glm::sign(inverse_w.x), glm::sign(inverse_w.y), inverse_w.z > 0.0 ? 1.0 : 0.0, 1.0);
  const double least_w = 1.0 / glm::dot(inverse_w, corner);
  if (!(least_w > 0.0))
    throw std::invalid_argument("the camera's matrices show nothing: w is never positive");
  const bool is_usual = is_usual_perspective(matrices);
  // In pixels, w may be 2^14 times as large; and it grows away from the camera.
  if (!(least_w >= kLeast && least_w <= (is_usual ? kLargest : 0x1p100)))
    throw std::invalid_argument("the least w that the camera's matrices show is out of the range of float");
  origin = is_usual ? glm::dvec3(from_view[3]) : glm::dvec3(to_world * corner) * least_w;
  if (!has_inverse(to_clip, origin)) throw std::invalid_argument(kSingular);

  const glm::dmat4 to_image = viewport(width_px, height_px);
  const glm::dmat3 xyw_to_image(xyw(to_image[0]), xyw(to_image[1]), xyw(to_image[3]));
  pixels = xyw_to_image * glm::dmat3(xyw(to_clip[0]), xyw(to_clip[1]), xyw(to_clip[2]));
  if (fine) to_pixels = PairMatrix(to_image) * (PairMatrix(matrices.projection) * PairMatrix(matrices.view));
  if (is_usual) {
    const glm::dmat4& p = matrices.projection;
    const double a = p[2].z / p[2].w, b = p[3].z;  // z / w = a + b / w, so a = far / (far - near)
    if (b > 0.0)
      throw std::invalid_argument("z / w falls with the distance; see ClipSpace::reversed in camera.h");
    volume.near_z = -b / a;
    const double far_z = a > 1.0 ? -b / (a - 1.0) : std::numeric_limits<double>::infinity();
    volume.far_z = far_z <= kLargest ? far_z : std::numeric_limits<double>::infinity();
    volume.far_w = 0.0;
    depth.near_z = volume.near_z, depth.scale = contract::kDepthRange * a;
    return;
  }
  at_origin = xyw_to_image * xyw(corner) * least_w;
  has_z = true;
  z = {to_clip[0].z, to_clip[1].z, to_clip[2].z, corner.z * least_w};
  if (glm::dvec3(inverse_w) == glm::dvec3(0.0)) axis = glm::dvec3(to_world[2]) * least_w;
}

ScreenTransform::ScreenTransform(const View& view, const glm::dmat4& model) : has_z(view.has_z) {
  const glm::dmat3 axes(model);
  // Along the axis, to the point nearest to the instance's origin. NaN if there is no axis.
  const glm::dvec3 place = glm::dvec3(model[3]) - view.origin;
  const double at = glm::dot(place, view.axis) / glm::dot(view.axis, view.axis);
  const glm::dvec3 along = at > 0.0 ? std::min(at, 1.0) * view.axis : glm::dvec3(0.0);
  const glm::dvec3 towards = view.origin + along - glm::dvec3(model[3]);
  origin = model_point(axes, towards);
  // A vertex at such a distance is beyond usual far planes, and must not become infinite or NaN.
  constexpr double kLargest = 0x1p125, kLargestOffset = 0x1p200;
  if (view.to_pixels) {
    PairMatrix m = *view.to_pixels * PairMatrix(within_range(model));
    m[3] = m * glm::tvec4<DoublePair>(glm::dvec4(origin, 1.0));
    for (int i = 0; i < 4; ++i) {
      const glm::dvec4 column(m[i]);
      exact[i] = xyw(column), z[i] = column.z, w[i] = column.w;
    }
  } else {
    for (int i = 0; i < 3; ++i) origin[i] = rounded_to_float(origin[i]);
    const glm::dvec3 offset = glm::clamp(axes * origin - towards, -kLargestOffset, kLargestOffset);
    for (int i = 0; i < 3; ++i) exact[i] = view.pixels * axes[i];
    exact[3] = view.pixels * offset + view.at_origin;
    if (has_z) {
      const glm::dvec3 z_of(view.z);
      z = glm::dvec4(z_of * axes, glm::dot(z_of, offset + along) + view.z.w);
      w = glm::dvec4(exact[0].z, exact[1].z, exact[2].z, exact[3].z);
      z = glm::clamp(z, -kLargestOffset, kLargestOffset), w = glm::clamp(w, -kLargestOffset, kLargestOffset);
    }
  }
  for (int i = 0; i < 4; ++i) rounded[i] = glm::clamp(exact[i], -kLargest, kLargest);
}

ClipVertex ScreenTransform::operator()(glm::vec3 position) const {
  const glm::dvec4 p(glm::dvec3(position) - origin, 1.0);
  const glm::dvec3 v = exact * p;
  return {v.x, v.y, has_z ? glm::dot(z, p) : v.z, v.z};
}

}  // namespace edgewise

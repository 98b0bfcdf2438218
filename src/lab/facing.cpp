// The registry of facing methods, the exact facts, and the score. A method is a file in facing_methods/ that
// defines facing_NAME, and a line here.
#include "lab/facing.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

#define EDGEWISE_FACING_METHODS(X) \
  X(snapped_area)                  \
  X(float_area)                    \
  X(normal_dot_eye)                \
  X(normal_dot_centroid)           \
  X(normal_dot_mean_ray)           \
  X(normal_dot_object)             \
  X(normal_z)

namespace edgewise::lab {

#define EDGEWISE_DECLARE(name) extern const FacingMethod facing_##name;
EDGEWISE_FACING_METHODS(EDGEWISE_DECLARE)

std::span<const FacingMethod> facing_methods() {
#define EDGEWISE_ENTRY(name) facing_##name,
  static const std::array list{EDGEWISE_FACING_METHODS(EDGEWISE_ENTRY)};
  return list;
}

namespace {

struct Point {
  mpq_class x, y;  // px
};

mpq_class cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

class Projector {
 public:
  explicit Projector(const FacingView& view) : view_(view) {}
  Point operator()(glm::vec3 p) const {
    const mpq_class w = view_.perspective ? along(view_.forward, p) : mpq_class(1);
    const mpq_class scale = mpq_class(double{view_.focal_px}) / w;
    return {mpq_class(view_.size.width) / 2 + scale * along(view_.right, p),
            mpq_class(view_.size.height) / 2 + scale * along(view_.down, p)};
  }

 private:
  mpq_class along(glm::vec3 axis, glm::vec3 p) const {
    mpq_class sum;
    for (int i = 0; i < 3; ++i)
      sum += mpq_class(double{axis[i]}) * (mpq_class(double{p[i]}) - mpq_class(double{view_.eye[i]}));
    return sum;
  }
  FacingView view_;
};

// The pixel whose sample is the first at or after a coordinate.
int first_pixel(const mpq_class& px, int limit) {
  const mpq_class shifted = px - mpq_class(1, 2);
  mpz_class up;
  mpz_cdiv_q(up.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  if (up <= 0) return 0;
  return up >= limit ? limit : static_cast<int>(up.get_si());
}

// Even-odd rule along each row of samples; what lies between two crossings, the first included, is inside.
bool owns_pixel(std::span<const Point> polygon, Size size) {
  mpq_class top = polygon[0].y, bottom = polygon[0].y;
  for (const Point& p : polygon) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  for (int y = first_pixel(top, size.height); y < first_pixel(bottom, size.height); ++y) {
    const mpq_class sample = mpq_class(2 * y + 1, 2);
    std::vector<mpq_class> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= sample) != (b.y <= sample))
        crossings.emplace_back(a.x + (sample - a.y) * (b.x - a.x) / (b.y - a.y));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      if (first_pixel(crossings[i], size.width) < first_pixel(crossings[i + 1], size.width)) return true;
  }
  return false;
}

// The signs are exact; these are measures of how close it was, for which long double does: 2^-64 against
// bounds of 2^-24.
using Real3 = glm::tvec3<long double>;

void measure_rays(FaceFacts& facts, std::span<const glm::vec3> v, Real3 object, const FacingView& view) {
  const Real3 a(v[0]), b(v[1]), c(v[2]), eye(view.eye), forward(view.forward);
  const Real3 normal = glm::cross(c - a, b - a), ray = (a + b + c) / 3.0L - eye;
  const Real3 sight = view.perspective ? ray : forward;
  const long double area = glm::length(normal);
  const long double height = glm::dot(normal, view.perspective ? a - eye : forward);
  facts.sine = static_cast<double>(std::abs(height) / (area * glm::length(sight)));
  const auto sine_to = [&](Real3 other) {
    return static_cast<double>(glm::length(glm::cross(ray, other)) / (glm::length(ray) * glm::length(other)));
  };
  facts.tilt_sine = sine_to(forward);
  facts.object_sine = sine_to(object - eye);
  facts.magnification = static_cast<double>(std::max(1.0L, glm::length(c - a) * glm::length(b - a) / area) *
                                            (1 + glm::length(eye) / glm::length(ray)));
}

void measure_screen(FaceFacts& facts, std::span<const glm::vec3> v, std::span<const Point> p,
                    const mpq_class& area, const FacingView& view) {
  double longest = 0, reach = 0, extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class dx = p[i].x - p[(i + 1) % 3].x, dy = p[i].y - p[(i + 1) % 3].y;
    longest = std::max(longest, std::hypot(dx.get_d(), dy.get_d()));
    const glm::dvec3 ray = glm::dvec3(v[i]) - glm::dvec3(view.eye);
    const double w = view.perspective ? glm::dot(ray, glm::dvec3(view.forward)) : 1.0;
    reach = std::max(reach, glm::length(ray) / w);
    extent = std::max({extent, std::abs(p[i].x.get_d()), std::abs(p[i].y.get_d())});
  }
  facts.width_px = std::abs(area.get_d()) / longest;
  // Three roundings a dot product, one a quotient, one a sum; each relative to the longest vector that takes
  // part.
  facts.rounding_px =
      0x1p-24 *
      (8 * double{view.focal_px} * reach * (view.perspective ? std::max(1.0, reach) : 1.0) + 2 * extent);
}

}  // namespace

std::vector<FaceFacts> facing_facts(const FacingScene& scene) {
  const Projector project(scene.view);
  std::vector<FaceFacts> all;
  std::vector<Point> polygon;
  Real3 object(0.0L);
  for (const auto& p : scene.positions) object += Real3(p) / static_cast<long double>(scene.positions.size());
  for (const Face& face : scene.faces) {
    const auto vertices = std::span(scene.positions).subspan(face.first, face.count);
    polygon.clear();
    for (const auto& p : vertices) polygon.push_back(project(p));
    mpq_class area;
    for (std::size_t i = 2; i < polygon.size(); ++i) area += cross(polygon[0], polygon[i - 1], polygon[i]);
    const mpq_class first_three = cross(polygon[0], polygon[1], polygon[2]);
    FaceFacts facts{};
    facts.owns_pixel = sgn(area) != 0 && owns_pixel(polygon, scene.view.size);
    facts.front = sgn(area) > 0;
    facts.first_three_lie = sgn(first_three) != sgn(area);
    measure_rays(facts, vertices, object, scene.view);
    measure_screen(facts, vertices, polygon, first_three, scene.view);
    all.push_back(facts);
  }
  return all;
}

FacingScore score(const FacingMethod& method, const FacingScene& scene, std::span<const FaceFacts> facts) {
  std::vector<std::uint8_t> said(scene.faces.size()), ours(said.size());
  method.classify(scene, said);
  facing_methods().front().classify(scene, ours);
  FacingScore score;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (said[i] != ours[i]) ++score.disagreements;
    if (!facts[i].owns_pixel) continue;
    ++score.faces;
    if ((said[i] != 0) == facts[i].front) continue;
    ++score.misclassified;
    if (!facts[i].first_three_lie && !method.may_err(facts[i], scene.view)) ++score.broken;
  }
  return score;
}

}  // namespace edgewise::lab

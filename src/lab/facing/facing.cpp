// The exact facts about faces, and the score of a facing method.
#include "lab/facing/facing.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "edgewise/scene.h"
#include "frontend/fixed.h"

namespace edgewise::lab {

namespace {

// In pixels; snapped points are in sub-units.
struct Point {
  mpq_class x, y;
};
struct SnappedPoint {
  std::int64_t x, y;  // in the guard band, so that products of two differences fit
};

template <typename P>
auto cross(const P& o, const P& a, const P& b) {
  return decltype(a.x)((a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x));
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
int first_pixel(std::int64_t q15, int limit) {
  const std::int64_t up = (q15 - contract::kHalf_q15 + contract::kPixel_q15 - 1) >> contract::kFineBits;
  return static_cast<int>(std::clamp<std::int64_t>(up, 0, limit));
}

mpq_class sample(const Point&, int pixel) {
  return mpq_class(2 * pixel + 1, 2);
}
std::int64_t sample(const SnappedPoint&, int pixel) {
  return contract::sample_q15(pixel);
}

// The x at which the edge from a to b, which must not be horizontal, crosses height y. In 2^-15 px it
// is rounded up, which does not change first_pixel().
mpq_class crossing(const Point& a, const Point& b, const mpq_class& y) {
  return a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
}
std::int64_t crossing(const SnappedPoint& a, const SnappedPoint& b, std::int64_t y) {
  const std::int64_t n = (y - a.y) * (b.x - a.x), d = b.y - a.y;
  return a.x + n / d + (n % d != 0 && (n < 0) == (d < 0) ? 1 : 0);
}

// Even-odd rule along each row of samples: from an odd crossing, included, to the next one lies inside.
template <typename P>
bool covers_sample(std::span<const P> polygon, Size size) {
  auto top = polygon[0].y, bottom = polygon[0].y;
  for (const P& p : polygon) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  std::vector<int> crossings;
  for (int y = first_pixel(top, size.height); y < first_pixel(bottom, size.height); ++y) {
    const auto height = sample(polygon[0], y);
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const P &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= height) != (b.y <= height))
        crossings.push_back(first_pixel(crossing(a, b, height), size.width));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      if (crossings[i] < crossings[i + 1]) return true;
  }
  return false;
}

int sign(const mpq_class& v) {
  return sgn(v);
}
int sign(std::int64_t v) {
  return (v > 0) - (v < 0);
}

template <typename P>
FaceSide side_of(std::span<const P> polygon, Size size) {
  auto area = cross(polygon[0], polygon[1], polygon[2]);
  const int first_three = sign(area);
  for (std::size_t i = 3; i < polygon.size(); ++i) area += cross(polygon[0], polygon[i - 1], polygon[i]);
  return {sign(area) != 0 && covers_sample(polygon, size), sign(area) > 0, first_three != sign(area)};
}

// Orientations are exact. Double suffices for the measures of how near a face is to edge-on: it rounds to
// 2^-53, and the methods' bounds are multiples of 2^-24.
void measure_rays(FaceFacts& facts, std::span<const glm::vec3> v, glm::dvec3 object, const FacingView& view) {
  const glm::dvec3 a(v[0]), b(v[1]), c(v[2]), eye(view.eye), forward(view.forward);
  const glm::dvec3 ray = (a + b + c) / 3.0 - eye, sight = view.perspective ? ray : forward;
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    normal += glm::cross(glm::dvec3(v[i + 1]) - a, glm::dvec3(v[i]) - a);
  const double area = glm::length(normal);
  double least = area * glm::length(sight);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double height = glm::dot(normal, view.perspective ? glm::dvec3(v[i]) - eye : forward);
    facts.normal_differs |= !(facts.source.front ? height < 0 : height > 0);
    if (i < 3) least = std::min(least, std::abs(height));
  }
  facts.sine = least / (area * glm::length(sight));
  const auto sine_to = [&](glm::dvec3 other) {
    return glm::length(glm::cross(ray, other)) / (glm::length(ray) * glm::length(other));
  };
  facts.tilt_sine = sine_to(forward);
  facts.object_sine = sine_to(object - eye);
  facts.magnification = 1 + glm::length(eye) / glm::length(ray);
}

void measure_screen(FaceFacts& facts, std::span<const glm::vec3> v, std::span<const Point> p,
                    const FacingView& view) {
  double longest = 0, reach = 0, extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class dx = p[i].x - p[(i + 1) % 3].x, dy = p[i].y - p[(i + 1) % 3].y;
    longest = std::max(longest, glm::length(glm::dvec2(dx.get_d(), dy.get_d())));
    const glm::dvec3 ray = glm::dvec3(v[i]) - glm::dvec3(view.eye);
    const double w = view.perspective ? glm::dot(ray, glm::dvec3(view.forward)) : 1.0;
    reach = std::max(reach, glm::length(ray) / w);
    extent = std::max({extent, std::abs(p[i].x.get_d()), std::abs(p[i].y.get_d())});
  }
  facts.width_px = std::abs(cross(p[0], p[1], p[2]).get_d()) / longest;
  // Three roundings per dot product, one per quotient, one per sum; each relative to the longest vector
  // involved.
  facts.rounding_px =
      0x1p-24 *
      (8 * double{view.focal_px} * reach * (view.perspective ? std::max(1.0, reach) : 1.0) + 2 * extent);
}

// `object` is the mean of all positions.
FaceFacts facts_of(const FacingScene& scene, const Face& face, glm::dvec3 object) {
  const FacingView& view = scene.view;
  const auto vertices = std::span(scene.positions).subspan(face.first, face.count);
  const Projector exactly(view);
  const FloatProjector in_float(view);
  std::vector<Point> floats;
  std::vector<SnappedPoint> snapped;
  for (const auto& p : vertices) {
    floats.push_back(exactly(p));
    const glm::vec2 px = in_float(p);
    snapped.push_back({snap(px.x), snap(px.y)});
  }
  FaceFacts facts{};
  facts.snapped = side_of<SnappedPoint>(snapped, view.size);
  facts.source = side_of<Point>(floats, view.size);
  measure_rays(facts, vertices, object, view);
  measure_screen(facts, vertices, floats, view);
  return facts;
}

}  // namespace

void FacingScene::add_face(std::size_t first) {
  const auto vertices = std::span<const glm::vec3>(positions).subspan(first);
  faces.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(vertices.size()),
                   face_normal(vertices)});
}

std::vector<FaceFacts> facing_facts(const FacingScene& scene, int threads) {
  glm::dvec3 object(0.0);
  for (const auto& p : scene.positions) object += glm::dvec3(p) / static_cast<double>(scene.positions.size());
  std::vector<FaceFacts> all(scene.faces.size());
  parallel_for(threads, static_cast<int>(all.size()), [&](int n) {
    const auto i = static_cast<std::size_t>(n);
    all[i] = facts_of(scene, scene.faces[i], object);
  });
  return all;
}

FacingScores score(const FacingMethod& method, const FacingScene& scene, std::span<const FaceFacts> facts) {
  std::vector<std::uint8_t> kept(scene.faces.size());
  method.classify(scene, kept);
  FacingScores scores;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto add = [&](FacingScore& score, const FaceSide& side, bool may_err) {
      const bool misled = method.by_normal ? facts[i].normal_differs : side.first_three_differ;
      if (!side.covers_sample) return;
      ++score.faces;
      if ((kept[i] != 0) == side.front) return;
      ++score.misclassified;
      if (misled)
        ++score.misled;
      else if (!may_err)
        ++scores.broken;
    };
    add(scores.snapped, facts[i].snapped, !method.info.exact);
    add(scores.source, facts[i].source, method.may_err(facts[i], scene.view));
  }
  return scores;
}

}  // namespace edgewise::lab

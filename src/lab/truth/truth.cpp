#include "lab/truth/truth.h"

#include <cmath>

#include "lab/truth/scan.h"

namespace edgewise::lab {

namespace {

__extension__ using Wide = __int128;

// Twice the signed area of (o, a, b), in the arithmetic of T.
template <typename T>
T cross(const T& ox, const T& oy, const T& ax, const T& ay, const T& bx, const T& by) {
  return T((ax - ox) * (by - oy)) - T((ay - oy) * (bx - ox));
}

// Depth at s of the plane through three vertices, each weighted by the area opposite to it.
template <typename T>
T plane(const T (&x)[3], const T (&y)[3], const T (&z)[3], const T& sx, const T& sy) {
  const T w0 = cross(x[1], y[1], x[2], y[2], sx, sy), w1 = cross(x[2], y[2], x[0], y[0], sx, sy),
          w2 = cross(x[0], y[0], x[1], y[1], sx, sy);
  return T(T(w0 * z[0]) + T(w1 * z[1]) + T(w2 * z[2])) / cross(x[0], y[0], x[1], y[1], x[2], y[2]);
}

template <typename T, typename From>
T plane_of(const From (&x)[3], const From (&y)[3], const double (&z)[3], double sx, double sy) {
  const T xs[3] = {T(x[0]), T(x[1]), T(x[2])}, ys[3] = {T(y[0]), T(y[1]), T(y[2])},
          zs[3] = {T(z[0]), T(z[1]), T(z[2])};
  return plane(xs, ys, zs, T(sx), T(sy));
}

int sign_of(Wide v) {
  return (v > 0) - (v < 0);
}

int snapped_side(const ScreenTriangle& t, std::size_t from, std::size_t to, Wide sx, Wide sy) {
  return sign_of(
      cross(Wide{t.x_q15[from]}, Wide{t.y_q15[from]}, Wide{t.x_q15[to]}, Wide{t.y_q15[to]}, sx, sy));
}

int float_side(const double (&x)[3], const double (&y)[3], std::size_t from, std::size_t to, double sx,
               double sy) {
  const Ball estimate = cross(Ball(x[from]), Ball(y[from]), Ball(x[to]), Ball(y[to]), Ball(sx), Ball(sy));
  if (const int sign = estimate.sign(); sign != 0) return sign;
  return sgn(cross(mpq_class(x[from]), mpq_class(y[from]), mpq_class(x[to]), mpq_class(y[to]), mpq_class(sx),
                   mpq_class(sy)));
}

constexpr double sample_px(int pixel) {
  return pixel + 0.5;
}

SnappedTruth truth_of(const ScreenTriangle& t) {
  return SnappedTruth(t);
}
FloatTruth truth_of(const FloatTriangle& t) {
  return FloatTruth(t.at);
}

// A cheap test before the exact truth: whether the triangle's bounding box reaches these rows.
template <typename Y>
bool reaches_rows(const Y (&y)[3], double units_per_px, Window rows) {
  const auto [low, high] = std::minmax({y[0], y[1], y[2]});
  return static_cast<double>(high) >= rows.y0 * units_per_px &&
         static_cast<double>(low) <= rows.y1() * units_per_px;
}
bool reaches_rows(const ScreenTriangle& t, Window rows) {
  return reaches_rows(t.y_q15, 32768.0, rows);
}
bool reaches_rows(const FloatTriangle& t, Window rows) {
  return reaches_rows(t.at.y_px, 1.0, rows);
}

template <typename Triangle>
std::vector<Run> runs_of(std::span<const Triangle> triangles, Window window, int threads) {
  return all_runs(
      triangles.size(), [&](std::size_t i) { return truth_of(triangles[i]); }, window, threads);
}

template <typename Triangle>
VisibleTriangles visible_of(std::span<const Triangle> triangles, Window window, int threads) {
  return VisibleTriangleFinder(
             triangles.size(), [&](std::size_t i) { return truth_of(triangles[i]); },
             [&](std::size_t i, Window rows) { return reaches_rows(triangles[i], rows); }, window)
      .run(threads);
}

}  // namespace

PixelBounds pixels_between(double x0, double y0, double x1, double y1, Window window) {
  const auto clip = [](double v, int low, int high) {
    return static_cast<int>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
  };
  return {clip(std::floor(x0), window.x0, window.x1()), clip(std::floor(y0), window.y0, window.y1()),
          clip(std::ceil(x1), window.x0, window.x1()), clip(std::ceil(y1), window.y0, window.y1())};
}

SnappedTruth::SnappedTruth(const ScreenTriangle& triangle)
    : ScreenTruth(triangle.y_q15, snapped_side(triangle, 0, 1, triangle.x_q15[2], triangle.y_q15[2])),
      triangle_(triangle) {}

bool SnappedTruth::accepts(std::size_t edge, int px, int py) const {
  return FillRule::accepts(edge, snapped_side(triangle_, edge, (edge + 1) % 3, Wide{px} * 32768 + 16384,
                                              Wide{py} * 32768 + 16384));
}

mpq_class SnappedTruth::depth(int px, int py) const {
  const double z[3] = {double(triangle_.z[0]), double(triangle_.z[1]), double(triangle_.z[2])};
  return plane_of<mpq_class>(triangle_.x_q15, triangle_.y_q15, z, sample_px(px) * 32768,
                             sample_px(py) * 32768);
}

Ball SnappedTruth::depth_estimate(int px, int py) const {
  const double z[3] = {double(triangle_.z[0]), double(triangle_.z[1]), double(triangle_.z[2])};
  return plane_of<Ball>(triangle_.x_q15, triangle_.y_q15, z, sample_px(px) * 32768, sample_px(py) * 32768);
}

FloatTruth::FloatTruth(const double (&x_px)[3], const double (&y_px)[3])
    : ScreenTruth(y_px, float_side(x_px, y_px, 0, 1, x_px[2], y_px[2])),
      x_{x_px[0], x_px[1], x_px[2]},
      y_{y_px[0], y_px[1], y_px[2]} {}

FloatTruth::FloatTruth(const UnsnappedTriangle& t)
    : FloatTruth({double{t.x_px[0]}, double{t.x_px[1]}, double{t.x_px[2]}},
                 {double{t.y_px[0]}, double{t.y_px[1]}, double{t.y_px[2]}}) {
  for (int i = 0; i < 3; ++i) z_[i] = double{t.z01[i]};
}

bool FloatTruth::accepts(std::size_t edge, int px, int py) const {
  return FillRule::accepts(edge, float_side(x_, y_, edge, (edge + 1) % 3, sample_px(px), sample_px(py)));
}

mpq_class FloatTruth::depth(int px, int py) const {
  return plane_of<mpq_class>(x_, y_, z_, sample_px(px), sample_px(py));
}

Ball FloatTruth::depth_estimate(int px, int py) const {
  return plane_of<Ball>(x_, y_, z_, sample_px(px), sample_px(py));
}

std::vector<Run> covered_runs(std::span<const ScreenTriangle> triangles, Window window, int threads) {
  return runs_of(triangles, window, threads);
}
std::vector<Run> covered_runs(std::span<const FloatTriangle> triangles, Window window, int threads) {
  return runs_of(triangles, window, threads);
}
std::vector<glm::dvec3> FloatSource::outline(std::uint32_t triangle) const {
  const UnsnappedTriangle& t = triangles_[triangle].at;
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 3; ++i) corners.emplace_back(t.x_px[i], t.y_px[i], t.z01[i]);
  return corners;
}

VisibleTriangles exact_visible_triangles(std::span<const ScreenTriangle> triangles, Window window,
                                         int threads) {
  return visible_of(triangles, window, threads);
}
VisibleTriangles exact_visible_triangles(std::span<const FloatTriangle> triangles, Window window,
                                         int threads) {
  return visible_of(triangles, window, threads);
}

}  // namespace edgewise::lab

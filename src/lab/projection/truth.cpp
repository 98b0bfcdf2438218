#include "lab/projection/truth.h"

#include <algorithm>
#include <cmath>

#include "core/finite.h"
#include "core/trigonometry.h"
#include "frontend/view.h"
#include "lab/truth/scan.h"

namespace edgewise::lab {

namespace {

int sign(const Ball& v) {
  return v.sign();
}
int sign(const mpq_class& v) {
  return sgn(v);
}

ClipMatrix<mpq_class> product(const ClipMatrix<mpq_class>& a, const glm::dmat4& b) {
  ClipMatrix<mpq_class> result;
  for (std::size_t row = 0; row < kClipRows; ++row)
    for (int column = 0; column < 4; ++column)
      for (int k = 0; k < 4; ++k)
        result[row][static_cast<std::size_t>(column)] += a[row][static_cast<std::size_t>(k)] * b[column][k];
  return result;
}

Ball rounded(const mpq_class& v) {
  const double nearest = v.get_d();  // rounds towards 0
  return {nearest, v == nearest ? 0.0 : 0x1p-52 * std::abs(nearest) + 0x1p-1022};
}
ClipMatrix<Ball> rounded(const ClipMatrix<mpq_class>& m) {
  const auto row = [&](std::size_t i) {
    return std::array{rounded(m[i][0]), rounded(m[i][1]), rounded(m[i][2]), rounded(m[i][3])};
  };
  return {row(kXw), row(kYw), row(kW), row(kNearSide), row(kFarSide)};
}

template <typename T>
ClipPoint<T> times(const ClipMatrix<T>& m, const glm::vec3& position) {
  const T x(double{position.x}), y(double{position.y}), z(double{position.z});
  const auto row = [&](std::size_t i) {
    return T(T(m[i][0] * x) + T(m[i][1] * y) + T(m[i][2] * z) + m[i][3]);
  };
  return {row(kXw), row(kYw), row(kW), row(kNearSide), row(kFarSide)};
}

template <typename T>
using Row = std::array<T, 3>;

template <typename T>
Row<T> cross(const Row<T>& a, const Row<T>& b) {
  return {T(T(a[1] * b[2]) - T(a[2] * b[1])), T(T(a[2] * b[0]) - T(a[0] * b[2])),
          T(T(a[0] * b[1]) - T(a[1] * b[0]))};
}
template <typename T>
T dot(const Row<T>& a, const Row<T>& b) {
  return T(T(a[0] * b[0]) + T(a[1] * b[1]) + T(a[2] * b[2]));
}

}  // namespace

ClipMatrix<mpq_class> exact_matrix(const Scene& scene, Size size, const glm::dmat4& model) {
  const double half_w = size.width / 2.0, half_h = size.height / 2.0;
  if (scene.matrices) {
    const ClipMatrix<mpq_class> to_pixels{
        {{half_w, 0, 0, half_w}, {0, -half_h, 0, half_h}, {0, 0, 0, 1}, {0, 0, 1, 0}, {0, 0, -1, 1}}};
    return product(product(product(to_pixels, scene.matrices->projection), scene.matrices->view), model);
  }
  const Camera& camera = scene.camera;
  const double focal_px = half_h / tangent(double{camera.fov_y} / 2.0), near_z = camera.near_z,
               far_z = camera.far_z;
  const ClipMatrix<mpq_class> to_pixels{{{focal_px, 0, -half_w, 0},
                                         {0, -focal_px, -half_h, 0},
                                         {0, 0, -1, 0},
                                         {0, 0, -1, -near_z},
                                         {0, 0, 1, far_z}}};
  glm::dmat4 from_camera(1.0);
  from_camera[3] = glm::dvec4(-camera.position, 1.0);
  return product(product(product(to_pixels, glm::dmat4(to_camera_frame(camera))), from_camera), model);
}

template <typename T>
Conditions<T>::Conditions(const ClipPoint<T>& a, const ClipPoint<T>& b, const ClipPoint<T>& c, double x0_px,
                          double y0_px)
    : x0(x0_px), y0(y0_px) {
  const auto vertex = [&](const ClipPoint<T>& v) {
    return Row<T>{T(v[kXw] - T(T(x0) * v[kW])), T(v[kYw] - T(T(y0) * v[kW])), v[kW]};
  };
  const Row<T> p = vertex(a), q = vertex(b), r = vertex(c);
  side[0] = cross(q, r), side[1] = cross(r, p), side[2] = cross(p, q);
  det = dot(p, side[0]);
  // At the hit, each edge's function is det times a vertex's weight over w. So these are det over w times the
  // plane's function.
  for (const auto& [plane, row] : {std::pair(kNear, kNearSide), std::pair(kFar, kFarSide)})
    for (std::size_t k = 0; k < 3; ++k)
      side[plane][k] = dot<T>({a[row], b[row], c[row]}, {side[0][k], side[1][k], side[2][k]});
}

template struct Conditions<Ball>;
template struct Conditions<mpq_class>;

struct SceneTruth::Estimate {
  static constexpr std::size_t kMost = Conditions<Ball>::kCount;

  Conditions<Ball> conditions;
  PixelBounds box;
  std::size_t sides;              // of the conditions that must be tested: the edges or all
  std::array<int, kMost> lean{};  // exact, as in FillRule
  std::array<bool, kMost> accepts_ties{};
};

// As lab/truth/scan.h asks.
class SceneTruth::TriangleTruth {
 public:
  static constexpr double kDepthError = 0x1p-36;

  TriangleTruth(const SceneTruth& scene, std::size_t triangle)
      : scene_(scene), triangle_(triangle), facing_(scene.facing_[triangle]) {
    if (facing_ != 0) estimate_ = &scene.estimates_[scene.estimate_of_[triangle]];
  }

  int facing() const { return facing_; }
  std::size_t sides() const { return estimate_->sides; }
  int lean(std::size_t i) const { return estimate_->lean[i]; }
  bool accepts(std::size_t i, double x_px, double y_px) const {
    int side = sign(estimate_->conditions.at(i, x_px, y_px));
    if (side == 0) side = sign(scene_.exact(triangle_).at(i, x_px, y_px));
    return side == 0 ? estimate_->accepts_ties[i] : side == facing_;
  }
  bool accepts(std::size_t i, int px, int py) const { return accepts(i, px + 0.5, py + 0.5); }
  bool covers(double x_px, double y_px) const {
    if (facing_ == 0) return false;
    std::size_t i = 0;
    while (i < sides() && accepts(i, x_px, y_px)) ++i;
    return i == sides();
  }
  double crossing(std::size_t i, int py) const {
    const Conditions<Ball>& c = estimate_->conditions;
    return c.x0 - ((py + 0.5 - c.y0) * c.side[i][1].value + c.side[i][2].value) / c.side[i][0].value;
  }
  PixelBounds box(Window w) const {
    const PixelBounds& b = estimate_->box;
    return {std::max(b.x0, w.x0), std::max(b.y0, w.y0), std::min(b.x1, w.x1()), std::min(b.y1, w.y1())};
  }

  Ball depth_estimate(double x_px, double y_px) const { return depth(estimate_->conditions, x_px, y_px); }
  Ball depth_estimate(int px, int py) const { return depth_estimate(px + 0.5, py + 0.5); }
  mpq_class depth(double x_px, double y_px) const { return depth(scene_.exact(triangle_), x_px, y_px); }
  mpq_class depth(int px, int py) const { return depth(px + 0.5, py + 0.5); }

 private:
  template <typename T>
  T depth(const Conditions<T>& c, double x_px, double y_px) const {
    if (scene_.scene_.matrices) return T(c.at(Conditions<T>::kNear, x_px, y_px) / c.det);
    // The edges' functions add up to det over w. Errors of w count near / w times here.
    const T sum = T(T(c.at(0, x_px, y_px) + c.at(1, x_px, y_px)) + c.at(2, x_px, y_px));
    const double near_z = scene_.scene_.camera.near_z;
    return T(T(scene_.depth_scale_) * T(T(1.0) - T(T(T(near_z) * sum) / c.det)));
  }

  const SceneTruth& scene_;
  std::size_t triangle_;
  int facing_;
  const Estimate* estimate_ = nullptr;  // if it draws something
};

SceneTruth::SceneTruth(Scene scene, Size size, Cull cull)
    : scene_(std::move(scene)), size_(size), depth_scale_(1.0) {
  if (!scene_.matrices) {
    const double near_z = scene_.camera.near_z, far_z = scene_.camera.far_z;
    depth_scale_ = far_z / (far_z - near_z);
  }
  std::size_t triangles = 0;
  for (const Instance& instance : scene_.instances)
    triangles += scene_.meshes.at(instance.mesh).triangles.size();
  exact_of_ = std::make_unique<Exact[]>(triangles);
  std::vector<ClipPoint<Ball>> vertices;
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    const Mesh& mesh = scene_.meshes.at(scene_.instances[i].mesh);
    exact_.push_back(exact_matrix(scene_, size, model_matrix(mesh, scene_.instances[i])));
    rounded_.push_back(rounded(exact_.back()));
    vertices.clear();
    for (const glm::vec3& p : mesh.positions) vertices.push_back(times(rounded_.back(), p));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      sources_.emplace_back(i, t), facing_.push_back(0), estimate_of_.push_back(0);
      const auto triangle = static_cast<std::uint32_t>(sources_.size() - 1);
      const glm::uvec3 v = mesh.triangles[t];
      const auto finite = [&](std::uint32_t vertex) { return is_finite(mesh.positions.at(vertex)); };
      if (finite(v.x) && finite(v.y) && finite(v.z))
        add(triangle, mesh.has_flag(t, kTwoSided) ? Cull::none : cull, vertices[v.x], vertices[v.y],
            vertices[v.z]);
    }
  }
}

void SceneTruth::add(std::uint32_t triangle, Cull cull, const ClipPoint<Ball>& a, const ClipPoint<Ball>& b,
                     const ClipPoint<Ball>& c) {
  using Point = ClipPoint<Ball>;
  const auto all = [&](int sign, auto&& value) {
    return value(a).sign() == sign && value(b).sign() == sign && value(c).sign() == sign;
  };
  const auto near_side = [](const Point& p) { return p[kNearSide]; };
  const auto far_side = [](const Point& p) { return p[kFarSide]; };
  // If all vertices lie beyond one side, the whole triangle does, whatever the signs of w.
  if (all(-1, near_side) || all(-1, far_side) || all(-1, [](const Point& p) { return p[kXw]; }) ||
      all(-1, [](const Point& p) { return p[kYw]; }) ||
      all(-1, [&](const Point& p) { return size_.width * p[kW] - p[kXw]; }) ||
      all(-1, [&](const Point& p) { return size_.height * p[kW] - p[kYw]; }))
    return;
  // The box around the vertices on the screen; the whole image if one may lie behind the camera.
  Box box{0.0, 0.0, double(size_.width), double(size_.height)};
  if (all(1, [](const Point& p) { return p[kW]; })) {
    const auto low = [&](ClipRow axis) {
      const auto of = [&](const Point& p) {
        const Ball at = p[axis] / p[kW];
        return at.value - at.error;
      };
      return std::min({of(a), of(b), of(c)});
    };
    const auto high = [&](ClipRow axis) {
      const auto of = [&](const Point& p) {
        const Ball at = p[axis] / p[kW];
        return at.value + at.error;
      };
      return std::max({of(a), of(b), of(c)});
    };
    box = {low(kXw), low(kYw), high(kXw), high(kYw)};
  }
  const PixelBounds pixels = pixels_between(box.x0, box.y0, box.x1, box.y1, {size_.width, size_.height});
  Estimate estimate{{a, b, c, double(pixels.x0), double(pixels.y0)}, pixels, Conditions<Ball>::kNear};
  const auto sign_of = [&](const Ball& guess, auto&& value) {
    return guess.sign() != 0 ? guess.sign() : sign(value(exact(triangle)));
  };
  const int facing = sign_of(estimate.conditions.det, [](const auto& of) { return of.det; });
  if (facing == 0 || !keeps(cull, facing)) return;
  if (!all(1, near_side) || !all(1, far_side)) estimate.sides = Estimate::kMost;
  for (std::size_t i = 0; i < estimate.sides; ++i) {
    const auto coefficient = [&](std::size_t k) {
      return facing * sign_of(estimate.conditions.side[i][k], [&](const auto& of) { return of.side[i][k]; });
    };
    // A sample on a plane is covered; one on an edge, if it is a left edge or a top edge.
    estimate.lean[i] = coefficient(0);
    estimate.accepts_ties[i] =
        i >= Conditions<Ball>::kNear || estimate.lean[i] > 0 || (estimate.lean[i] == 0 && coefficient(1) > 0);
  }
  facing_[triangle] = static_cast<std::int8_t>(facing);
  estimate_of_[triangle] = static_cast<std::uint32_t>(estimates_.size());
  estimates_.push_back(estimate);
}

SceneTruth::~SceneTruth() = default;

const glm::vec3& SceneTruth::position(std::size_t triangle, int k) const {
  const auto [instance, index] = sources_[triangle];
  const Mesh& mesh = scene_.meshes[scene_.instances[instance].mesh];
  return mesh.positions[mesh.triangles[index][k]];
}

SceneTruth::TriangleTruth SceneTruth::truth_of(std::size_t triangle) const {
  return {*this, triangle};
}

ClipPoint<Ball> SceneTruth::estimate(std::size_t triangle, int k) const {
  return times(rounded_[sources_[triangle].first], position(triangle, k));
}

ClipPoint<mpq_class> SceneTruth::exact(std::size_t triangle, int k) const {
  return times(exact_[sources_[triangle].first], position(triangle, k));
}

const Conditions<mpq_class>& SceneTruth::exact(std::size_t triangle) const {
  Exact& found = exact_of_[triangle];
  std::call_once(found.once, [&] {
    found.conditions = std::make_unique<const Conditions<mpq_class>>(exact(triangle, 0), exact(triangle, 1),
                                                                     exact(triangle, 2), 0.0, 0.0);
  });
  return *found.conditions;
}

std::vector<Run> SceneTruth::runs(Window window, int threads) const {
  return all_runs(
      size(), [&](std::size_t i) { return truth_of(i); }, window, threads);
}

VisibleTriangles SceneTruth::visible_triangles(Window window, int threads) const {
  const auto reaches_rows = [&](std::size_t i, Window rows) {
    if (facing_[i] == 0) return false;
    const PixelBounds& box = estimates_[estimate_of_[i]].box;
    return box.y0 < rows.y1() && box.y1 > rows.y0;
  };
  return VisibleTriangleFinder(
             size(), [&](std::size_t i) { return truth_of(i); }, reaches_rows, window)
      .run(threads);
}

std::vector<glm::dvec3> SceneTruth::outline(std::uint32_t triangle) const {
  if (facing_[triangle] == 0) return {};
  std::vector<ClipPoint<double>> polygon, cut;
  for (int k = 0; k < 3; ++k) {
    const ClipPoint<Ball> p = estimate(triangle, k);
    polygon.push_back({p[0].value, p[1].value, p[2].value, p[3].value, p[4].value});
  }
  for (const ClipRow plane : {kNearSide, kFarSide}) {
    cut.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      if (from[plane] >= 0.0) cut.push_back(from);
      if ((from[plane] >= 0.0) == (to[plane] >= 0.0)) continue;
      const double t = from[plane] / (from[plane] - to[plane]);
      ClipPoint<double>& added = cut.emplace_back();
      for (std::size_t row = 0; row < kClipRows; ++row) added[row] = from[row] + t * (to[row] - from[row]);
    }
    polygon.swap(cut);
  }
  std::vector<glm::dvec3> corners;
  for (const auto& p : polygon)
    corners.emplace_back(p[kXw] / p[kW], p[kYw] / p[kW], depth_scale_ * p[kNearSide] / p[kW]);
  return corners;
}

bool SceneTruth::covers(std::uint32_t triangle, double x_px, double y_px) const {
  return truth_of(triangle).covers(x_px, y_px);
}

bool SceneTruth::nearer(std::uint32_t a, std::uint32_t b, double x_px, double y_px) const {
  const TriangleTruth one = truth_of(a), other = truth_of(b);
  const int guess = sign(one.depth_estimate(x_px, y_px) - other.depth_estimate(x_px, y_px));
  return guess != 0 ? guess < 0 : one.depth(x_px, y_px) < other.depth(x_px, y_px);
}

double SceneTruth::depth01(std::uint32_t triangle, double x_px, double y_px) const {
  const TriangleTruth truth = truth_of(triangle);
  const Ball estimate = truth.depth_estimate(x_px, y_px);
  return estimate.error <= truth.kDepthError ? estimate.value : truth.depth(x_px, y_px).get_d();
}

bool SceneTruth::misses(std::uint32_t triangle, const Box& box) const {
  const Conditions<Ball>& c = estimates_[estimate_of_[triangle]].conditions;
  const auto fails = [&](std::size_t i, double x, double y) {
    return sign(c.at(i, x, y)) * facing_[triangle] < 0;
  };
  for (std::size_t i = 0; i < Conditions<Ball>::kCount; ++i)
    if (fails(i, box.x0, box.y0) && fails(i, box.x1, box.y0) && fails(i, box.x0, box.y1) &&
        fails(i, box.x1, box.y1))
      return true;
  return false;
}

}  // namespace edgewise::lab

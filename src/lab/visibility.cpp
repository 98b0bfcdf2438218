// The registry of visibility methods, the exact owners, and the score. A method is a file in
// visibility_methods/ that defines visibility_NAME, and a line here.
#include "lab/visibility.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/truth.h"

#define EDGEWISE_VISIBILITY_METHODS(X) \
  X(contract31)                        \
  X(reversed_z)                        \
  X(float_z)                           \
  X(unorm24)                           \
  X(unorm16)                           \
  X(painter_farthest)                  \
  X(painter_mean)                      \
  X(submission_order)

namespace edgewise::lab {

#define EDGEWISE_DECLARE(name) extern const VisibilityMethod visibility_##name;
EDGEWISE_VISIBILITY_METHODS(EDGEWISE_DECLARE)

std::span<const VisibilityMethod> visibility_methods() {
#define EDGEWISE_ENTRY(name) visibility_##name,
  static const std::array list{EDGEWISE_VISIBILITY_METHODS(EDGEWISE_ENTRY)};
  return list;
}

namespace {

// A triangle's weights at a sample: the doubled areas opposite the vertices, all of one sign inside.
class Plane {
 public:
  explicit Plane(const VisibilityTriangle& t) : triangle_(t) {}

  void look_at(int px, int py) {
    const std::int64_t sx = std::int64_t{px} * 256 + 128, sy = std::int64_t{py} * 256 + 128;
    const auto &x = triangle_.screen.x_sub, &y = triangle_.screen.y_sub;
    for (int i = 0; i < 3; ++i) {
      const int p = (i + 1) % 3, q = (i + 2) % 3;
      weight_[i] = (x[q] - x[p]) * (sy - y[p]) - (y[q] - y[p]) * (sx - x[p]);
    }
  }
  // 1 / distance. Inside the triangle no two terms have opposite signs, so nothing cancels and the relative
  // error is a few roundings.
  template <typename Real>
  Real nearness() const {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) sum += static_cast<Real>(weight_[i]) / static_cast<Real>(triangle_.view_z[i]);
    return sum / static_cast<Real>(weight_[0] + weight_[1] + weight_[2]);
  }
  mpq_class exact_nearness() const {
    mpq_class sum;
    for (int i = 0; i < 3; ++i) sum += mpq_class(weight_[i]) / mpq_class(triangle_.view_z[i]);
    return sum / mpq_class(weight_[0] + weight_[1] + weight_[2]);
  }

 private:
  VisibilityTriangle triangle_;
  std::int64_t weight_[3] = {};
};

// Whether `a` is strictly nearer than `b`, where both last looked; doubles decide unless they are too close.
bool nearer(const Plane& a, double a_nearness, const Plane& b, double b_nearness) {
  if (std::abs(a_nearness - b_nearness) > 1e-14 * b_nearness) return a_nearness > b_nearness;
  return a.exact_nearness() > b.exact_nearness();
}

long double depth01_of(long double nearness, const VisibilityScene& s) {
  const long double near_z = s.near_z, far_z = s.far_z;
  return far_z / (far_z - near_z) * (1.0L - near_z * nearness);
}

// The depths that methods keep, against the planes of the triangles they say they belong to.
class DepthErrors {
 public:
  DepthErrors(const VisibilityMethod& method, const VisibilityScene& scene)
      : method_(method), scene_(scene) {}

  // False if the promise is broken.
  bool add(const VisibilityFrame& frame, std::size_t pixel, std::uint32_t owner, long double truth) {
    const long double stored = method_.stored01(frame, pixel), ulp = method_.ulp01(truth);
    const long double error = std::abs(stored - truth), steps = error / ulp;
    max_ = std::max(max_, steps);
    squares_ += steps * steps;
    ++count_;
    const auto& triangle = scene_.triangles[owner];
    const auto [nearest, farthest] =
        std::minmax({triangle.view_z[0], triangle.view_z[1], triangle.view_z[2]});
    const long double low = depth01_of(1.0L / nearest, scene_), high = depth01_of(1.0L / farthest, scene_);
    if (stored < low - 0x1p-16L || stored > high + 0x1p-16L) ++out_of_range_;
    return error <= method_.bound01(triangle, scene_);
  }
  void report(VisibilityScore& score) const {
    score.out_of_range = out_of_range_;
    score.max_ulp = static_cast<double>(max_);
    if (count_ > 0)
      score.rms_ulp = static_cast<double>(std::sqrt(squares_ / static_cast<long double>(count_)));
  }

 private:
  const VisibilityMethod& method_;
  const VisibilityScene& scene_;
  long double max_ = 0, squares_ = 0;
  std::uint64_t count_ = 0, out_of_range_ = 0;
};

// Whether the two owners' true depths are so close that the method's promise lets it choose either. Where the
// method shows the background, that is a depth of 1.
bool may_confuse(const VisibilityMethod& method, const VisibilityScene& scene, std::uint32_t said,
                 std::uint32_t truth, int x, int y) {
  const auto bound = [&](std::uint32_t id) {
    return id == kNobody ? 0.0 : method.bound01(scene.triangles[id], scene);
  };
  const auto depth = [&](std::uint32_t id) { return id == kNobody ? 1.0L : true_depth01(scene, id, x, y); };
  return std::abs(depth(said) - depth(truth)) <= bound(said) + bound(truth);
}

}  // namespace

std::vector<std::uint32_t> true_owners(const VisibilityScene& scene) {
  const auto width = static_cast<std::size_t>(scene.width);
  std::vector<std::uint32_t> owners(width * static_cast<std::size_t>(scene.height), kNobody);
  std::vector<double> nearness(owners.size(), 0.0);
  std::vector<Plane> planes;
  std::vector<ScreenTriangle> screen;
  for (const auto& triangle : scene.triangles) {
    planes.emplace_back(triangle);
    screen.push_back(triangle.screen);
  }
  for (const Run& run : covered_runs(screen, {scene.width, scene.height}, 1))
    for (int x = run.x0; x < run.x1; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(run.y) * width + static_cast<std::size_t>(x);
      Plane& plane = planes[run.triangle];
      plane.look_at(x, run.y);
      const auto mine = plane.nearness<double>();
      if (owners[pixel] != kNobody) {
        Plane& other = planes[owners[pixel]];
        other.look_at(x, run.y);
        if (!nearer(plane, mine, other, nearness[pixel])) continue;
      }
      owners[pixel] = run.triangle;
      nearness[pixel] = mine;
    }
  return owners;
}

long double true_depth01(const VisibilityScene& scene, std::uint32_t triangle, int x, int y) {
  Plane plane(scene.triangles[triangle]);
  plane.look_at(x, y);
  return depth01_of(plane.nearness<long double>(), scene);
}

VisibilityScore score(const VisibilityMethod& method, const VisibilityScene& scene,
                      std::span<const std::uint32_t> owners) {
  VisibilityFrame frame;
  method.draw(scene, frame);
  VisibilityScore score;
  DepthErrors errors(method, scene);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x);
      const std::uint32_t said = frame.owner[pixel], truth = owners[pixel];
      const bool keeps_depth = method.stored01 != nullptr;
      bool broken = said == kNobody ? truth != kNobody && !keeps_depth
                                    : !SnappedTruth(scene.triangles[said].screen).covers(x, y);
      if (truth != kNobody) ++score.covered;
      if (said != truth) ++score.wrong_owner;
      if (keeps_depth) {
        if (said != kNobody && !errors.add(frame, pixel, said, true_depth01(scene, said, x, y)))
          broken = true;
        if (said != truth && !may_confuse(method, scene, said, truth, x, y)) broken = true;
      }
      if (broken) ++score.broken;
    }
  errors.report(score);
  return score;
}

}  // namespace edgewise::lab

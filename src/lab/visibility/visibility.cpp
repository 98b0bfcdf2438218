// The exact visible triangles, and the score of a visibility method.
#include "lab/visibility/visibility.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

#include "edgewise/contract.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

namespace {

// A triangle's plane in one truth.
class Plane {
 public:
  Plane(const VisibilityTriangle& t, bool snapped) {
    for (int i = 0; i < 3; ++i) {
      x_[i] = snapped ? t.screen.x_q15[i] / double{contract::kPixel_q15} : double{t.x_px[i]};
      y_[i] = snapped ? t.screen.y_q15[i] / double{contract::kPixel_q15} : double{t.y_px[i]};
      z_[i] = t.view_z[i];
    }
  }
  // 1 / distance, in the arithmetic of T: the mean of the vertices' 1 / view_z, weighted by the areas
  // opposite to them. Inside the triangle no two terms have opposite signs, so nothing cancels.
  template <typename T>
  T nearness(int px, int py) const {
    const T x(px + 0.5), y(py + 0.5);
    T sum(0.0), weights(0.0);
    for (int i = 0; i < 3; ++i) {
      const int p = (i + 1) % 3, q = (i + 2) % 3;
      const T weight =
          T(T(T(x_[q]) - T(x_[p])) * T(y - T(y_[p]))) - T(T(T(y_[q]) - T(y_[p])) * T(x - T(x_[p])));
      sum = T(sum + weight / T(z_[i]));
      weights = T(weights + weight);
    }
    return T(sum / weights);
  }

 private:
  double x_[3], y_[3], z_[3];
};

double depth01_of(double nearness, const VisibilityScene& s) {
  const double near_z = s.near_z, far_z = s.far_z;
  return far_z / (far_z - near_z) * (1.0 - near_z * nearness);
}

std::size_t pixel_at(const VisibilityScene& scene, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x);
}

std::vector<std::uint32_t> visible_triangles_of(const VisibilityScene& scene, std::span<const Run> runs,
                                                bool snapped) {
  std::vector<Plane> planes;
  for (const auto& triangle : scene.triangles) planes.emplace_back(triangle, snapped);
  const auto pixels = static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  std::vector<std::uint32_t> visible(pixels, kNoTriangle);
  std::vector<Ball> nearness(pixels, Ball(0.0));
  for (const Run& run : runs)
    for (int x = run.x0; x < run.x1; ++x) {
      const std::size_t pixel = pixel_at(scene, x, run.y);
      const Ball mine = planes[run.triangle].nearness<Ball>(x, run.y);
      if (visible[pixel] != kNoTriangle) {
        const auto exact = [&](std::uint32_t id) { return planes[id].nearness<mpq_class>(x, run.y); };
        const int sign = (mine - nearness[pixel]).sign();
        if (sign < 0 || (sign == 0 && exact(run.triangle) <= exact(visible[pixel]))) continue;
      }
      visible[pixel] = run.triangle;
      nearness[pixel] = mine;
    }
  return visible;
}

// Scores a method's picture against one truth.
class Judge {
 public:
  Judge(const VisibilityMethod& method, const VisibilityScene& scene, bool snapped)
      : method_(method), scene_(scene), snapped_(snapped) {}

  bool covers(std::uint32_t id, int x, int y) const {
    const VisibilityTriangle& t = scene_.triangles[id];
    if (snapped_) return SnappedTruth(t.screen).covers(x, y);
    if (scene_.truth) return scene_.truth->covers(t.screen.payload, x + 0.5, y + 0.5);
    return FloatTruth({{t.x_px[0], t.x_px[1], t.x_px[2]}, {t.y_px[0], t.y_px[1], t.y_px[2]}, {}})
        .covers(x, y);
  }
  // The background's depth is 1. Accurate to about 2^-51 on snapped positions.
  double depth01(std::uint32_t id, int x, int y) const {
    if (id == kNoTriangle) return 1.0;
    if (!snapped_ && scene_.truth)
      return scene_.truth->depth01(scene_.triangles[id].screen.payload, x + 0.5, y + 0.5);
    return depth01_of(Plane(scene_.triangles[id], snapped_).nearness<double>(x, y), scene_);
  }
  // Returns the error of the stored depth, in depth01.
  double add_depth(const VisibilityFrame& frame, std::uint32_t triangle, int x, int y) {
    const double truth = depth01(triangle, x, y), stored = method_.stored01(frame, pixel_at(scene_, x, y));
    const auto& z = scene_.triangles[triangle].view_z;
    const auto [nearest, farthest] = std::minmax({z[0], z[1], z[2]});
    const double low = depth01_of(1.0 / nearest, scene_), high = depth01_of(1.0 / farthest, scene_);
    if (stored < low - 0x1p-16 || stored > high + 0x1p-16) ++score_.out_of_range;
    return std::abs(stored - truth);
  }
  void add_visible(std::uint32_t drawn, std::uint32_t truth) {
    if (truth != kNoTriangle) ++score_.covered;
    if (drawn != truth) ++score_.wrong_triangle;
  }
  const VisibilityScore& score() const { return score_; }

 private:
  const VisibilityMethod& method_;
  const VisibilityScene& scene_;
  bool snapped_;
  VisibilityScore score_;
};

// Scores against both truths at once, so that the picture is drawn only once.
class Scorer {
 public:
  Scorer(const VisibilityMethod& method, const VisibilityScene& scene)
      : method_(method), scene_(scene), snapped_(method, scene, true), source_(method, scene, false) {
    method.draw(scene, frame_);
  }
  void add(int x, int y, const TrueVisibleTriangles& visible) {
    const std::size_t pixel = pixel_at(scene_, x, y);
    const std::uint32_t drawn = frame_.visible[pixel];
    add_source(drawn, visible.source[pixel], x, y);
    if (!keeps_promise(drawn, visible.snapped[pixel], x, y)) ++scores_.broken;
  }
  VisibilityScores report() {
    scores_.snapped = snapped_.score();
    scores_.source = source_.score();
    return scores_;
  }

 private:
  bool keeps_depth() const { return method_.stored01 != nullptr; }
  double bound01(std::uint32_t id) const {
    return id == kNoTriangle ? 0.0 : method_.bound01(scene_.triangles[id], scene_);
  }

  void add_source(std::uint32_t drawn, std::uint32_t truth, int x, int y) {
    const std::uint32_t source =
        drawn == kNoTriangle || !scene_.truth ? drawn : scene_.triangles[drawn].screen.payload;
    source_.add_visible(source, truth);
    if (drawn == kNoTriangle || !keeps_depth()) return;
    if (source == truth || source_.covers(drawn, x, y)) source_.add_depth(frame_, drawn, x, y);
  }
  bool keeps_promise(std::uint32_t drawn, std::uint32_t truth, int x, int y) {
    snapped_.add_visible(drawn, truth);
    if (drawn != kNoTriangle && drawn != truth && !snapped_.covers(drawn, x, y)) return false;
    if (!keeps_depth())
      return drawn == truth || (drawn != kNoTriangle && method_.may_occlude(scene_, drawn, truth));
    const bool right_depth =
        drawn == kNoTriangle || snapped_.add_depth(frame_, drawn, x, y) <= bound01(drawn);
    if (drawn == truth) return right_depth;
    // A pixel that shows the background has depth 1.
    const double apart = std::abs(snapped_.depth01(drawn, x, y) - snapped_.depth01(truth, x, y));
    if (apart > bound01(drawn) + bound01(truth)) return false;
    ++scores_.depth_ties;
    return right_depth;
  }

  const VisibilityMethod& method_;
  const VisibilityScene& scene_;
  VisibilityFrame frame_;
  Judge snapped_, source_;
  VisibilityScores scores_;
};

}  // namespace

std::vector<std::uint32_t> snapped_visible_triangles(const VisibilityScene& scene) {
  std::vector<ScreenTriangle> screen;
  for (const VisibilityTriangle& t : scene.triangles) screen.push_back(t.screen);
  return visible_triangles_of(scene, covered_runs(screen, {scene.width, scene.height}, 1), true);
}

TrueVisibleTriangles true_visible_triangles(const VisibilityScene& scene) {
  const Window window{scene.width, scene.height};
  if (scene.truth)
    return {snapped_visible_triangles(scene), scene.truth->visible_triangles(window, 1).triangle};
  std::vector<FloatTriangle> floats;
  for (const VisibilityTriangle& t : scene.triangles)
    floats.push_back({{{t.x_px[0], t.x_px[1], t.x_px[2]}, {t.y_px[0], t.y_px[1], t.y_px[2]}, {}}, 0});
  return {snapped_visible_triangles(scene),
          visible_triangles_of(scene, covered_runs(floats, window, 1), false)};
}

VisibilityScores score(const VisibilityMethod& method, const VisibilityScene& scene,
                       const TrueVisibleTriangles& visible) {
  Scorer scorer(method, scene);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) scorer.add(x, y, visible);
  return scorer.report();
}

}  // namespace edgewise::lab

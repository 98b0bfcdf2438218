// The score of a clipping method.
#include "lab/clipping/clipping.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/parallel.h"
#include "lab/clipping/pipeline.h"
#include "lab/clipping/truth.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

ClippingFrame::ClippingFrame(Size size)
    : picture(size.width, size.height), backend(backends().front().make()) {}

namespace {

// Calls visit(x, y) for the sample and eight points around it until it returns true. Returns false if it
// never does.
template <typename Visit>
bool around(int px, int py, Visit&& visit) {
  for (const int dx : {0, -1, 1})
    for (const int dy : {0, -1, 1}) {
      const double reach = dx != 0 && dy != 0 ? kHairlinePx * 0.7071 : kHairlinePx;
      if (visit(px + 0.5 + dx * reach, py + 0.5 + dy * reach)) return true;
    }
  return false;
}

bool is_hairline(const ClippingOracle& oracle, int x, int y, std::uint32_t drawn, std::uint32_t truth) {
  return around(x, y, [&](double x_px, double y_px) { return oracle.shows(drawn, truth, x_px, y_px); });
}

bool is_depth_tie(const ClippingOracle& oracle, int x, int y, std::uint32_t drawn, std::uint32_t truth) {
  const auto depth01 = [&](std::uint32_t id) { return oracle.depth01(id, x + 0.5, y + 0.5); };
  return drawn != kNoTriangle && truth != kNoTriangle && oracle.covers(drawn, x + 0.5, y + 0.5) &&
         std::abs(depth01(drawn) - depth01(truth)) <= kDepthTie01;
}

// The distance in px from the image's centre to the nearer end of an edge that may cross the screen, else 0.
// Rounding the far ends moves the edge; a near end holds it in place.
double reach_px(const ClipVertex& a, const ClipVertex& b, Size size) {
  const auto beyond = [&](double ax, double bx, int limit) {
    return (ax < 0 && bx < 0) || (ax > limit * a.w && bx > limit * b.w);
  };
  if (beyond(a.x, b.x, size.width) || beyond(a.y, b.y, size.height)) return 0;
  const auto far_out = [&](const ClipVertex& v) {
    return std::max(std::abs(v.x / v.w - size.width / 2.0), std::abs(v.y / v.w - size.height / 2.0));
  };
  return std::min(far_out(a), far_out(b));
}

bool promises(const ClippingMethod& method, const ClippingScene& scene) {
  const Camera& camera = scene.scene.camera;
  if (!method.anywhere && camera.position != glm::dvec3(0.0)) return false;
  if (camera.far_z > method.far_over_near * camera.near_z) return false;
  const ToClip to_clip(scene);
  const ViewVolume view = view_of(scene);
  Clipper clipper;
  return std::all_of(scene.mesh().triangles.begin(), scene.mesh().triangles.end(), [&](glm::uvec3 t) {
    const auto& p = scene.mesh().positions;
    const ClipVertex vertices[3] = {to_clip(p[t.x]), to_clip(p[t.y]), to_clip(p[t.z])};
    unsigned sides = 0;
    for (const ClipVertex& v : vertices) sides |= outside_of(v, view) & unsigned{kNear | kFar | kNotFinite};
    const auto polygon = clipper.clip(vertices, kNear | kFar, view);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      sides |= outside_of(polygon[i], view);
      if (reach_px(polygon[i], polygon[(i + 1) % polygon.size()], scene.size) > method.reach_px) return false;
    }
    return (sides & method.fails_on) == 0;
  });
}

// Scores a method's picture pixel by pixel.
class Scorer {
 public:
  explicit Scorer(const ClippingTruth& truth) : oracle_(*truth.oracle) {}

  void add(int x, int y, std::uint32_t drawn, std::uint32_t truth, double stored01) {
    if (truth != kNoTriangle) ++score.covered;
    if (drawn == truth) {
      if (drawn != kNoTriangle) add_depth(x, y, drawn, stored01);
    } else if (is_hairline(oracle_, x, y, drawn, truth)) {
      ++score.hairline;
    } else if (drawn == kNoTriangle) {
      ++score.missing;
    } else if (truth == kNoTriangle) {
      ++score.extra;
    } else {
      ++score.wrong_triangle;
      if (is_depth_tie(oracle_, x, y, drawn, truth)) ++score.depth_ties;
    }
  }

  ClippingScore score;

 private:
  void add_depth(int x, int y, std::uint32_t triangle, double stored01) {
    double low = 2, high = -1;
    around(x, y, [&](double x_px, double y_px) {
      const double here = oracle_.depth01(triangle, x_px, y_px);
      low = std::min(low, here), high = std::max(high, here);
      return false;
    });
    if (stored01 < low - 0x1p-20 || stored01 > high + 0x1p-20) ++score.wrong_depth;
  }

  const ClippingOracle& oracle_;
};

}  // namespace

std::uint64_t correct(std::span<std::uint32_t> picture, Size size, const ClippingOracle& oracle,
                      int threads) {
  std::atomic<std::uint64_t> replaced = 0;
  const auto width = static_cast<std::size_t>(size.width);
  parallel_for(threads, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      std::uint32_t& drawn = picture[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
      const std::uint32_t truth = oracle.visible_at(x + 0.5, y + 0.5);
      if (drawn == truth || is_hairline(oracle, x, y, drawn, truth) ||
          is_depth_tie(oracle, x, y, drawn, truth))
        continue;
      drawn = truth;
      ++replaced;
    }
  });
  return replaced;
}

ClippingScore score(const ClippingMethod& method, const ClippingScene& scene, const ClippingTruth& truth) {
  ClippingFrame frame(scene.size);
  method.draw(scene, frame);
  Scorer scorer(truth);
  auto visible_it = truth.visible.begin();
  for (int y = 0; y < scene.size.height; ++y)
    for (int x = 0; x < scene.size.width; ++x, ++visible_it) {
      const std::uint32_t drawn = frame.picture.payload_row(y)[x];
      const double stored = static_cast<double>(frame.picture.depth_row(y)[x]) - contract::kDepthHead;
      scorer.add(x, y, drawn, *visible_it, stored / contract::kDepthRange);
    }
  ClippingScore& score = scorer.score;
  if (promises(method, scene)) score.broken = score.wrong() - score.depth_ties;
  return score;
}

}  // namespace edgewise::lab

// Shared by the visibility methods: depth planes, and the depth buffer's loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "edgewise/contract.h"
#include "lab/cases/exact_spans.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

// Plane is constructed from a triangle. row(x, y) starts a row, value(x) is the depth to compare and store,
// and nearer(a, b) is the depth test.
template <typename Plane, typename Word>
void draw_depth_buffer(const VisibilityScene& scene, VisibilityFrame& frame, std::vector<Word>& depth,
                       Word clear) {
  const auto width = static_cast<std::size_t>(scene.width),
             pixels = width * static_cast<std::size_t>(scene.height);
  frame.visible.assign(pixels, kNoTriangle);
  depth.assign(pixels, clear);
  for (std::uint32_t id = 0; id < scene.triangles.size(); ++id) {
    const VisibilityTriangle& triangle = scene.triangles[id];
    if (contract::signed_area(triangle.screen) == 0) continue;
    Plane plane(triangle, scene);
    for_each_span(triangle.screen, scene.width, scene.height, [&](int y, int begin, int end) {
      std::uint32_t* visible_row = frame.visible.data() + static_cast<std::size_t>(y) * width;
      Word* depth_row = depth.data() + static_cast<std::size_t>(y) * width;
      plane.row(begin, y);
      for (int x = begin; x < end; ++x) {
        const Word z = plane.value(x);
        if (!Plane::nearer(z, depth_row[x])) continue;
        depth_row[x] = z;
        visible_row[x] = id;
      }
    });
  }
}

// The plane through values at the three vertices, evaluated by its gradients in floating point.
template <typename Real>
class GradientPlane {
 public:
  GradientPlane(const ScreenTriangle& t, Real v0, Real v1, Real v2)
      : x0_q15_(t.x_q15[0]), y0_q15_(t.y_q15[0]), v0_(v0) {
    const auto px = [](std::int32_t q15) { return static_cast<Real>(q15) / Real{contract::kPixel_q15}; };
    const Real x1 = px(t.x_q15[1] - x0_q15_), x2 = px(t.x_q15[2] - x0_q15_);
    const Real y1 = px(t.y_q15[1] - y0_q15_), y2 = px(t.y_q15[2] - y0_q15_);
    const Real area =
        static_cast<Real>(contract::signed_area(t)) / Real{contract::kPixel_q15 * contract::kPixel_q15};
    gx_ = ((v1 - v0) * y2 - (v2 - v0) * y1) / area;
    gy_ = ((v2 - v0) * x1 - (v1 - v0) * x2) / area;
  }
  void row(int x, int y) {
    x_begin_ = x;
    row_ = v0_ + gx_ * px_from(x, x0_q15_) + gy_ * px_from(y, y0_q15_);
  }
  Real at(int x) const { return row_ + gx_ * static_cast<Real>(x - x_begin_); }

 private:
  static Real px_from(int pixel, std::int32_t q15) {
    return static_cast<Real>(contract::sample_q15(pixel) - q15) / Real{contract::kPixel_q15};
  }
  std::int32_t x0_q15_, y0_q15_;
  Real v0_, gx_, gy_, row_ = 0;
  int x_begin_ = 0;
};

template <typename Real>
Real depth01(Real view_z, const VisibilityScene& scene) {
  const Real near_z = static_cast<Real>(scene.near_z), far_z = static_cast<Real>(scene.far_z);
  return far_z / (far_z - near_z) * (1 - near_z / view_z);
}

// The factor by which gradients magnify a rounding: the longest side squared over twice the area, at least 1.
inline double magnification(const ScreenTriangle& t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const double dx = t.x_q15[i] - t.x_q15[(i + 1) % 3], dy = t.y_q15[i] - t.y_q15[(i + 1) % 3];
    longest = std::max(longest, dx * dx + dy * dy);
  }
  return std::max(1.0, longest / std::abs(static_cast<double>(contract::signed_area(t))));
}

// Depth as an unsigned normalized integer of `kBits` bits, as in most APIs. The plane is evaluated in double,
// since float does not have 24 exact bits to spare.
template <int kBits, typename Word>
class UnormPlane {
 public:
  static constexpr std::int32_t kMax = (1 << kBits) - 1;
  UnormPlane(const VisibilityTriangle& t, const VisibilityScene& s)
      : plane_(t.screen, depth01(t.view_z[0], s), depth01(t.view_z[1], s), depth01(t.view_z[2], s)) {}
  void row(int x, int y) { plane_.row(x, y); }
  Word value(int x) const {
    // Slivers may leave the range by more than a step.
    const double scaled = plane_.at(x) * kMax + 0.5;
    return static_cast<Word>(static_cast<std::int32_t>(std::clamp(scaled, 0.0, double{kMax})));
  }
  static bool nearer(Word a, Word b) { return a < b; }
  // Half a step, and the rounding of double.
  static double bound01(const VisibilityTriangle& t, const VisibilityScene&) {
    return 0.5 / kMax + 0x1p-49 * magnification(t.screen);
  }

 private:
  GradientPlane<double> plane_;
};

}  // namespace edgewise::lab

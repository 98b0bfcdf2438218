// Compares the two truths with rational arithmetic, with each other and with the contract's depth.
#include "lab/truth/truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::adversarial;
using testing::hard_floats;

// Another form of the fill rule: a sample is covered if it lies strictly inside after a move to the right by
// an infinitesimal and down by a far smaller one.
bool covered_by_rationals(const UnsnappedTriangle& t, int px, int py) {
  const mpq_class sx(px + 0.5), sy(py + 0.5);
  mpq_class x[3], y[3];
  for (int i = 0; i < 3; ++i) x[i] = double{t.x_px[i]}, y[i] = double{t.y_px[i]};
  const mpq_class area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const mpq_class along_x = y[i] - y[j], along_y = x[j] - x[i];
    const mpq_class here = along_x * (sx - x[i]) + along_y * (sy - y[i]);
    const int side = sgn(here) != 0 ? sgn(here) : sgn(along_x) != 0 ? sgn(along_x) : sgn(along_y);
    if (side * sgn(area) <= 0) return false;
  }
  return true;
}

TEST(FloatTruth, AgreesWithRationalArithmetic) {
  constexpr int kSide = 24;
  int covered = 0;
  for (const auto family : testing::kFloatFamilies)
    for (const auto& triangle : hard_floats(family, 150, {kSide, kSide}, 5)) {
      const FloatTruth truth(triangle.at);
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const bool expected = covered_by_rationals(triangle.at, x, y);
          ASSERT_EQ(truth.covers(x, y), expected)
              << family << " triangle " << triangle.payload << " at " << x << ", " << y;
          covered += expected;
        }
    }
  EXPECT_GT(covered, 10'000);
}

FloatTruth truth_of(const FloatTriangle& t) {
  return FloatTruth(t.at);
}
SnappedTruth truth_of(const ScreenTriangle& t) {
  return SnappedTruth(t);
}

template <typename Triangle>
void expect_runs_of(const std::vector<Triangle>& triangles, Window window, const std::string& what) {
  std::vector<Run> expected;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto truth = truth_of(triangles[i]);
    for (int y = window.y0; y < window.y1(); ++y)
      for (int x = window.x0; x < window.x1(); ++x) {
        if (!truth.covers(x, y)) continue;
        if (!expected.empty() && expected.back().triangle == i && expected.back().y == y &&
            expected.back().x1 == x)
          ++expected.back().x1;
        else
          expected.push_back({static_cast<std::uint32_t>(i), y, x, x + 1});
      }
  }
  for (const int threads : {1, 2})
    EXPECT_EQ(covered_runs(std::span<const Triangle>(triangles), window, threads), expected) << what;
}

TEST(CoveredRuns, HoldThePixelsThatTheTruthsCover) {
  for (const Window window : {Window{40, 30}, {17, 23, 60, 300}}) {
    for (const auto family : testing::kFloatFamilies)
      expect_runs_of(hard_floats(family, 120, window, 9), window, std::string(family));
    for (const auto family : testing::kFamilies)
      expect_runs_of(adversarial(family, 120, window.x1(), window.y1(), 10), window, std::string(family));
  }
  expect_runs_of(adversarial("cloud", 5'000, 60, 60, 1), {60, 60}, "more than one chunk");
}

// |value - exact| <= error.
void expect_inside(const Ball& ball, const mpq_class& exact) {
  if (std::isinf(ball.error)) return;
  const mpq_class off = abs(mpq_class(ball.value) - exact);
  ASSERT_LE(off, mpq_class(ball.error));
}

TEST(Ball, HoldsTheExactValueAfterEveryOperation) {
  Random random(3);
  for (int trial = 0; trial < 5'000; ++trial) {
    const auto number = [&] {
      const double scale = std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
      return static_cast<double>(random.uniform(-1.0f, 1.0f)) * scale;
    };
    Ball ball(number());
    mpq_class exact(ball.value);
    for (int step = 0; step < 8; ++step) {
      const double b = number();
      switch (random.below(4)) {
        case 0:
          ball = ball + Ball(b), exact += mpq_class(b);
          break;
        case 1:
          ball = ball - Ball(b), exact -= mpq_class(b);
          break;
        case 2:
          ball = ball * Ball(b), exact *= mpq_class(b);
          break;
        default:
          if (b == 0.0) break;
          ball = ball / Ball(b), exact /= mpq_class(b);
      }
      expect_inside(ball, exact);
      if (ball.sign() != 0) {
        ASSERT_EQ(ball.sign(), sgn(exact));
      }
    }
  }
}

TEST(Depth, EstimatesHoldTheExactDepthAndEqualItAtVertices) {
  for (const auto family : testing::kFloatFamilies)
    for (const auto& triangle : hard_floats(family, 60, {30, 30}, 12)) {
      const FloatTruth truth(triangle.at);
      if (truth.facing() == 0) continue;
      for (int k = 0; k < 30; k += 5) expect_inside(truth.depth_estimate(k, 29 - k), truth.depth(k, 29 - k));
    }
  // Vertices at samples.
  const UnsnappedTriangle at{{0.5f, 20.5f, 3.5f}, {0.5f, 2.5f, 30.5f}, {0.1f, 0.7f, 0.3f}};
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(FloatTruth(at).depth(static_cast<int>(at.x_px[i]), static_cast<int>(at.y_px[i])),
              mpq_class(double{at.z01[i]}));
}

template <typename Triangle>
void expect_visible_triangles(const std::vector<Triangle>& triangles, Window window,
                              const std::string& what) {
  for (const int threads : {1, 2}) {
    const VisibleTriangles visible =
        exact_visible_triangles(std::span<const Triangle>(triangles), window, threads);
    std::size_t at = 0;
    for (int y = window.y0; y < window.y1(); ++y)
      for (int x = window.x0; x < window.x1(); ++x, ++at) {
        std::uint32_t nearest = kNoTriangle;
        mpq_class depth;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
          const auto truth = truth_of(triangles[i]);
          if (!truth.covers(x, y)) continue;
          const mpq_class here = truth.depth(x, y);
          if (nearest != kNoTriangle && here >= depth) continue;
          nearest = static_cast<std::uint32_t>(i);
          depth = here;
        }
        ASSERT_EQ(visible.triangle[at], nearest) << what << " at " << x << ", " << y;
        if (nearest == kNoTriangle)
          ASSERT_TRUE(std::isinf(visible.depth[at]));
        else
          ASSERT_LE(abs(mpq_class(visible.depth[at]) - depth), abs(depth) * mpq_class(0x1p-40)) << what;
      }
  }
}

TEST(VisibleTriangles, AreTheNearestByRationals) {
  const Window window{20, 37, 3, 2};
  for (const auto family : {"anywhere", "near-centres", "slivers", "small"}) {
    auto floats = hard_floats(family, 30, window, 14);
    floats.push_back(floats[3]);  // a depth tie at every pixel
    expect_visible_triangles(floats, window, family);
  }
  for (const auto family : {"uniform", "ties", "slivers", "steep"})
    expect_visible_triangles(adversarial(family, 30, 24, 40, 15), window, family);
}

}  // namespace
}  // namespace edgewise::lab

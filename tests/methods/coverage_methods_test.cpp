// Checks every coverage method against its promise, and its SIMD forms against its scalar one.
#include <gtest/gtest.h>

#include <stdexcept>

#include "lab/coverage/coverage.h"
#include "lab/coverage/score.h"
#include "lab/coverage_support.h"
#include "scene/streams.h"

namespace edgewise::lab {
namespace {

using testing::adversarial;
using testing::drawn_by;
using testing::find_coverage_method;
using testing::hard_floats;
using testing::Picture;
using testing::picture_of;

float side_px(const UnsnappedTriangle& t) {
  const auto [low_x, high_x] = std::minmax({t.x_px[0], t.x_px[1], t.x_px[2]});
  const auto [low_y, high_y] = std::minmax({t.y_px[0], t.y_px[1], t.y_px[2]});
  return std::max(high_x - low_x, high_y - low_y);
}

std::vector<std::string_view> names_of(std::span<const CoverageMethod> methods) {
  std::vector<std::string_view> names;
  for (const CoverageMethod& method : methods) names.push_back(method.info.name);
  return names;
}

std::string text_of(const auto& size) {
  return " in " + std::to_string(size.width) + "x" + std::to_string(size.height);
}

class EveryCoverageMethod : public ::testing::TestWithParam<std::string_view> {
 protected:
  const CoverageMethod& method_ = find_coverage_method(GetParam());

  void expect_reach(std::vector<FloatTriangle> triangles, Window window, const std::string& what) {
    const auto too_large = static_cast<float>(method_.promise.max_side_px);
    std::erase_if(triangles, [&](const FloatTriangle& t) { return side_px(t.at) > too_large; });
    const Picture picture(std::move(triangles), window);
    const CoverageScore score = score_coverage(picture.by_floats, drawn_by(method_, picture), picture.floats);
    EXPECT_LE(score.worst_px, method_.promise.reach_px) << what;
    EXPECT_EQ(score.out_of_bounds, 0u) << what;
  }
};

TEST_P(EveryCoverageMethod, ErrsOnlyWithinItsReach) {
  for (const Window window : {Window{120, 90}, {64, 48, 4020, 4030}, {4096, 3, 0, 50}, {3, 4096, 4000, 0}})
    for (const auto family : testing::kFloatFamilies)
      for (const std::uint64_t seed : {1u, 2u})
        expect_reach(hard_floats(family, 60, window, seed), window, std::string(family) + text_of(window));
  for (const auto family : testing::kFamilies)
    expect_reach(testing::as_floats(adversarial(family, 100, 160, 120, 4)), {160, 120}, std::string(family));
}

// For triangles above its size limit a method may draw any pixels inside the bounding box.
TEST_P(EveryCoverageMethod, KeepsToTheBoxOfTrianglesTooLargeForIt) {
  const int largest = method_.promise.max_side_px, side = std::min(4096, 3 * largest);
  if (largest >= side) return;
  auto triangles = hard_floats("anywhere", 100, {side, side}, 5);
  std::erase_if(triangles,
                [&](const FloatTriangle& t) { return side_px(t.at) <= static_cast<float>(largest); });
  ASSERT_GT(triangles.size(), 20u);
  std::uint64_t extra = 0;
  for (const int x : {0, side / 2, side - 300})
    for (const int y : {0, side / 2, side - 200}) {
      const Picture picture(triangles, {300, 200, x, y});
      const CoverageScore score =
          score_coverage(picture.by_floats, drawn_by(method_, picture), picture.floats);
      EXPECT_EQ(score.out_of_box, 0u) << x << ", " << y;
      extra += score.extra;
    }
  EXPECT_GT(extra, 1000u) << "no method overflows";
}

TEST_P(EveryCoverageMethod, LeavesNoGapOrDoubleHitInAMeshIfItPromisesThat) {
  const CoveragePromise& promise = method_.promise;
  if (!promise.no_gaps && !promise.no_double_hits) return;
  for (const double cell_px : {9.0, 40.0, 150.0})
    for (const bool on_grid : {true, false}) {
      const double longest_px = 1.5 * cell_px;  // a cell and its jitter
      if ((promise.if_on_grid && !on_grid) || longest_px > promise.max_side_px) continue;
      auto mesh = float_triangles(jittered_grid({.width = 501, .height = 302}, cell_px, 31));
      if (on_grid) mesh = testing::as_floats(snapped(mesh));
      const Picture picture(std::move(mesh), {501, 302});
      ASSERT_EQ(picture.by_floats.covered, 501u * 302u);
      const Cracks cracks = testing::cracks_of(method_, picture);
      EXPECT_TRUE(cracks.gaps.empty() || !promise.no_gaps) << cell_px << " px, on grid: " << on_grid;
      EXPECT_TRUE(cracks.double_hits.empty() || !promise.no_double_hits)
          << cell_px << " px, on grid: " << on_grid;
    }
}

TEST_P(EveryCoverageMethod, DiffersFromTheTruthSomewhereUnlessItIsExact) {
  std::uint64_t off_grid_truth = 0, off_float_truth = 0;
  for (const auto& c : coverage_cases()) {
    const Picture& picture = picture_of(c.name);
    const DrawnRuns drawn = drawn_by(method_, picture);
    off_grid_truth += score_coverage(picture.by_grid, drawn, picture.floats).errors();
    off_float_truth += score_coverage(picture.by_floats, drawn, picture.floats).errors();
  }
  EXPECT_EQ(off_grid_truth == 0, method_.info.exact);
  EXPECT_GT(off_float_truth, 0u);
}

TEST_P(EveryCoverageMethod, ErrsBySnappingAloneIfItIsExact) {
  if (!method_.info.exact) return;
  const auto expect_exact = [&](const Picture& picture, std::string_view what) {
    CoverageScore perfect;
    const DrawnRuns drawn = drawn_by(method_, picture);
    EXPECT_EQ(score_coverage(picture.by_grid, drawn, picture.floats), perfect) << what;
    EXPECT_EQ(score_coverage(picture.by_floats, drawn, picture.floats),
              score_coverage(picture.by_floats, {picture.by_grid.runs, picture.window}, picture.floats))
        << what;
    EXPECT_EQ(testing::cracks_of(method_, picture).at_shared_edges(), 0u) << what;
  };
  for (const auto& c : coverage_cases()) expect_exact(picture_of(c.name), c.name);
  for (const auto family : testing::kFamilies)
    expect_exact({testing::as_floats(adversarial(family, 120, 97, 71, 6)), {97, 71}}, family);
  for (const auto family : testing::kFloatFamilies)
    expect_exact({hard_floats(family, 120, {97, 71}, 7), {97, 71}}, family);
}

// Triangles of constant depth, so that the nearest is known without rounding. Few depths cause many ties.
TEST_P(EveryCoverageMethod, DrawsTheNearestTriangleThatItCovers) {
  constexpr int kWidth = 90, kHeight = 70;
  auto triangles = hard_floats("anywhere", 60, {kWidth, kHeight}, 3);
  for (auto& t : triangles) t.at.z01[0] = t.at.z01[1] = t.at.z01[2] = std::floor(t.at.z01[0] * 8.0f) / 8.0f;
  const auto grid = snapped(triangles);
  const CoverageInput input{triangles, grid};
  std::vector<lab::Run> runs;
  method_.runs(input, {kWidth, kHeight}, runs);
  std::vector<std::uint32_t> expected(kWidth * kHeight, 0);  // payloads count from 1
  for (const lab::Run& run : runs)
    for (int x = run.x0; x < run.x1; ++x) {
      std::uint32_t& nearest = expected[static_cast<std::size_t>(run.y * kWidth + x)];
      const auto z = [&](std::uint32_t payload) { return triangles[payload - 1].at.z01[0]; };
      const std::uint32_t payload = run.triangle + 1;
      const auto rank = [&](std::uint32_t p) { return std::pair(z(p), p); };
      if (nearest == 0 || rank(payload) < rank(nearest)) nearest = payload;
    }
  Canvas canvas(kWidth, kHeight);
  for (const SimdTarget target : {SimdTarget::scalar, SimdTarget::best})
    for (const int threads : {1, 2, 1}) {
      method_.draw(input, canvas, {.threads = threads, .target = target});
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          ASSERT_EQ(canvas.frame.payload_row(y)[x], expected[static_cast<std::size_t>(y * kWidth + x)])
              << x << ", " << y;
    }
}

// ---- The same pixels and depths with every SIMD target

class EveryCoverageForm : public EveryCoverageMethod {
 protected:
  void expect_same(const std::vector<FloatTriangle>& floats, Size size, const std::string& what) {
    const std::vector<ScreenTriangle> grid =
        method_.contract_depth ? snapped(floats) : std::vector<ScreenTriangle>{};
    const CoverageInput input{floats, grid};
    Canvas plain(size.width, size.height), lanes(size.width, size.height);
    method_.draw(input, plain, {.target = SimdTarget::scalar});
    for (const SimdTarget target : supported_targets()) {
      method_.draw(input, lanes, {.target = target});
      EXPECT_TRUE(same_picture(method_, plain, lanes)) << what << ", " << name_of(target);
    }
  }
};

// Widths below, at and above a vector's, and images narrower than one.
constexpr Size kSizes[] = {{1, 1}, {5, 40}, {16, 16}, {17, 9}, {90, 70}, {301, 200}};

TEST_P(EveryCoverageForm, DrawsHardTriangles) {
  for (const Size size : kSizes)
    for (const auto family : testing::kFloatFamilies)
      expect_same(hard_floats(family, 150, {size.width, size.height}, 11), size,
                  std::string(family) + text_of(size));
}

TEST_P(EveryCoverageForm, DrawsMeshesOfSmallAndLargeCells) {
  constexpr Size kSize{700, 300};
  for (const double cell_px : {3.0, 12.0, 33.0, 150.0, 600.0})
    expect_same(float_triangles(jittered_grid({.width = kSize.width, .height = kSize.height}, cell_px, 5)),
                kSize, std::to_string(cell_px) + " px");
}

// Boxes far larger than the image, in which the edge values of 32-bit methods wrap.
TEST_P(EveryCoverageForm, DrawsTrianglesThatReachFarOutOfTheImage) {
  constexpr Size kSize{640, 90};
  Random random(17);
  for (const float reach : {200.0f, 3000.0f, 15000.0f}) {
    auto triangles = hard_floats("anywhere", 200, {kSize.width, kSize.height}, 17);
    for (FloatTriangle& t : triangles)
      for (int i = 0; i < 3; ++i) {
        t.at.x_px[i] += random.uniform(-reach, reach);
        t.at.y_px[i] += random.uniform(-reach, reach);
      }
    expect_same(triangles, kSize, std::to_string(reach) + " px outside");
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryCoverageMethod, ::testing::ValuesIn(names_of(coverage_methods())),
                         [](const auto& param) { return testing::test_name(param); });
INSTANTIATE_TEST_SUITE_P(Registry, EveryCoverageForm, ::testing::ValuesIn(names_of(coverage_methods())),
                         [](const auto& param) { return testing::test_name(param); });

TEST(CoverageMethods, RefuseTrianglesBeyondTheGuardBandForBackends) {
  const std::vector<FloatTriangle> far{{{{0, 30, 5}, {1, 9, 30}, {0, 0, 0}}, 1}};
  const auto grid = snapped(far);
  std::vector<lab::Run> runs;
  EXPECT_THROW(find_coverage_method("tiled").runs({far, grid}, {16, 16, 20000, 0}, runs),
               std::invalid_argument);
}

}  // namespace
}  // namespace edgewise::lab

// Coverage scores of runs with known results, the functions from which scores are computed, and visible
// triangles of coverage methods, checked by hand and by rule 6.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "lab/coverage/pixel_changes.h"
#include "lab/coverage/visible.h"
#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::Picture;

// A triangle of 15 pixels and one of a single pixel in a 5 x 5 window at (10, 20). The expected scores are
// computed by hand.
class Score : public ::testing::Test {
 protected:
  const Picture picture_{{{{{11.0f, 17.1f, 11.0f}, {21.0f, 21.0f, 27.1f}, {0, 0, 0}}, 1},
                          {{{11.0f, 11.0f, 12.1f}, {23.0f, 24.0f, 23.0f}, {0, 0, 0}}, 2}},
                         {5, 5, 10, 20}};
  CoverageScore score(std::vector<lab::Run> runs) {
    return score_coverage(picture_.by_floats, {std::move(runs), picture_.window}, picture_.floats);
  }
};

TEST_F(Score, CountsEachKindOfErrorSeparately) {
  const std::vector<lab::Run> truth{{0, 21, 11, 15}, {0, 22, 11, 15}, {0, 23, 11, 15}, {0, 24, 11, 14}};
  ASSERT_EQ(picture_.by_floats.runs.size(), 4u + 1u);
  ASSERT_TRUE(std::equal(truth.begin(), truth.end(), picture_.by_floats.runs.begin()));
  ASSERT_EQ(picture_.by_floats.covered, 16u);
  EXPECT_EQ(score(picture_.by_floats.runs).errors(), 0u);

  auto runs = truth;
  EXPECT_EQ(score(runs).missing, 1u);
  runs[0].x1 = 13;
  EXPECT_EQ(score(runs).missing, 3u);
  runs.push_back({1, 21, 13, 15});
  EXPECT_EQ(score(runs).extra, 2u);
  runs.push_back({0, 22, 11, 12});  // drawn twice for one triangle
  EXPECT_EQ(score(runs).extra, 2u);
  runs.push_back({0, 20, 10, 12});
  EXPECT_EQ(score(runs).extra, 4u);
  EXPECT_EQ(score(runs).out_of_box, 2u) << "the last run's pixels touch the box, so they do not count";
  runs.push_back({1, 24, 14, 15});
  EXPECT_EQ(score(runs).out_of_box, 3u);
  runs.push_back({1, 30, 10, 15});
  runs.push_back({1, 21, 8, 10});
  EXPECT_EQ(score(runs).out_of_bounds, 7u);
  EXPECT_EQ(score(runs).extra, 5u);
  EXPECT_NEAR(score(runs).worst_px, 14.5 - 12.1, 1e-5);
}

TEST(Crossings, AreTheLargerOfSampleRowsAndColumns) {
  const auto crossings = [](UnsnappedTriangle t) {
    return edge_crossings(std::vector{FloatTriangle{t, 1}}, {100, 50});
  };
  EXPECT_EQ(crossings({{0, 30, 30}, {0, 10, 0}, {}}), 30u + 10u + 30u);
  EXPECT_EQ(crossings({{0.6f, 30.4f, 30.4f}, {0, 10, 0}, {}}), 29u + 10u + 29u);
  EXPECT_EQ(crossings({{-100, 200, 200}, {20, 20, 20}, {}}), 100u + 100u) << "cut to the window";
  EXPECT_EQ(crossings({{-9, -2, -5}, {1, 8, 30}, {}}), 0u) << "outside";
}

TEST(Differences, AreHitsOfOnlyOneList) {
  using Hit = std::tuple<std::uint32_t, int, int>;  // a triangle, x, y
  Random random(17);
  for (int trial = 0; trial < 300; ++trial) {
    std::set<Hit> in_truth, in_drawn, missing, extra;
    const auto random_runs = [&](std::set<Hit>& hits) {
      std::vector<lab::Run> runs;
      for (std::uint32_t triangle = 0; triangle < 2; ++triangle)
        for (int y = 0; y < 3; ++y)
          for (int x = -3; x < 20;) {
            const int begin = x + 1 + static_cast<int>(random.below(6)),
                      end = begin + 1 + static_cast<int>(random.below(6));
            runs.push_back({triangle, y, begin, end});
            for (int i = begin; i < end; ++i) hits.insert({triangle, i, y});
            x = end + static_cast<int>(random.below(9));
          }
      return runs;
    };
    const auto truth = random_runs(in_truth), drawn = random_runs(in_drawn);
    for_each_difference(truth, drawn, [&](const lab::Run& run, bool is_missing) {
      for (int x = run.x0; x < run.x1; ++x)
        ASSERT_TRUE((is_missing ? missing : extra).insert({run.triangle, x, run.y}).second);
    });
    std::set<Hit> only_truth, only_drawn;
    std::ranges::set_difference(in_truth, in_drawn, std::inserter(only_truth, only_truth.end()));
    std::ranges::set_difference(in_drawn, in_truth, std::inserter(only_drawn, only_drawn.end()));
    ASSERT_EQ(missing, only_truth);
    ASSERT_EQ(extra, only_drawn);
  }
}

TEST(PixelChanges, AreSuperfluousIfThePixelChangesOftenerAndNotOnlyEarlierOrLater) {
  const auto beyond = [](std::vector<std::uint32_t> truth, std::vector<std::uint32_t> drawn) {
    PixelChanges exact, method;
    for (const std::uint32_t pixel : truth) exact.add({pixel});
    for (const std::uint32_t pixel : drawn) method.add({pixel});
    return method.beyond(exact);
  };
  EXPECT_EQ(beyond({1, 1, 2, 2}, {1, 2, 2, 2}), 0u) << "early";
  EXPECT_EQ(beyond({1, 1, 1, 1}, {1, 1, 1, 2}), 0u) << "the truth may change after the last frame";
  EXPECT_EQ(beyond({2, 2, 2, 2}, {1, 2, 2, 2}), 0u) << "the truth may have changed before the first one";
  EXPECT_EQ(beyond({1, 1, 1, 1}, {1, 2, 1, 1}), 2u);
  EXPECT_EQ(beyond({1, 1, 2, 2}, {1, 2, 1, 2}), 2u);
}

VisibleTriangleScore visible_triangles_of(std::string_view method, const Picture& picture) {
  return VisibleTriangleJudge({{picture.window.width, picture.window.height}, picture.floats, picture.grid},
                              picture.cracks.surface(), 2)
      .score(testing::find_coverage_method(method));
}

TEST(CoverageVisibleTriangles, TieRulesDecideTheDiagonalOfTheDrtkQuad) {
  const Picture& quad = testing::picture_of("drtk_quad");
  EXPECT_EQ(visible_triangles_of("float_lt", quad).wrong_source, 6u) << "the diagonal is not drawn";
  EXPECT_EQ(visible_triangles_of("float_le", quad).wrong_source, 6u)
      << "the first triangle draws the diagonal, which belongs to the second";
  EXPECT_EQ(visible_triangles_of("float_top_left", quad), VisibleTriangleScore{});
}

// Intersecting triangles: if two depths differ by less than the error of rule 6, the wrong triangle may be
// visible.
TEST(CoverageVisibleTriangles, OfBackendsErrOnlyWithinTheDepthErrorOfRuleSix) {
  for (const auto family : testing::kFamilies) {
    const auto grid = testing::adversarial(family, 150, 120, 90, 8);
    const Picture picture(testing::as_floats(grid), {120, 90});
    for (const auto& backend : backends())
      EXPECT_EQ(visible_triangles_of(backend.name, picture).unexplained, 0u)
          << backend.name << " in " << family;
  }
}

}  // namespace
}  // namespace edgewise::lab

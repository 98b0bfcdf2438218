// Every coverage method against its promise, and the smallest scenes against what they are said to show.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "coverage_support.h"
#include "lab/coverage_cases.h"
#include "lab/coverage_score.h"
#include "scene/streams.h"

namespace edgewise::lab {
namespace {

using testing::adversarial;
using testing::hard_floats;

// Triangles in both forms, and both truths.
struct Picture {
  Picture(std::vector<FloatTriangle> triangles, Window w)
      : floats(std::move(triangles)),
        grid(snapped(floats)),
        input{floats, grid},
        window(w),
        by_grid(snapped_coverage(input, w, 2)),
        by_floats(float_coverage(input, w, 2)) {}
  Picture(const Picture&) = delete;

  std::vector<FloatTriangle> floats;
  std::vector<ScreenTriangle> grid;
  CoverageInput input;
  Window window;
  CoverageTruth by_grid, by_floats;
};

std::unique_ptr<Picture> picture_of(const CoverageCase& c) {
  return std::make_unique<Picture>(c.make(), Window{c.size.width, c.size.height});
}

const Picture& picture_of(std::string_view name) {
  static std::map<std::string_view, std::unique_ptr<Picture>> pictures;
  auto& slot = pictures[name];
  if (!slot) slot = picture_of(find_coverage_case(name));
  return *slot;
}

CoverageScore against_grid(std::string_view method, const Picture& picture) {
  return score_coverage(picture.by_grid, find_coverage_method(method), picture.input);
}
CoverageScore against_floats(std::string_view method, const Picture& picture) {
  return score_coverage(picture.by_floats, find_coverage_method(method), picture.input);
}

float side_px(const UnsnappedTriangle& t) {
  const auto [low_x, high_x] = std::minmax({t.x_px[0], t.x_px[1], t.x_px[2]});
  const auto [low_y, high_y] = std::minmax({t.y_px[0], t.y_px[1], t.y_px[2]});
  return std::max(high_x - low_x, high_y - low_y);
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const auto& method : coverage_methods()) names.push_back(method.info.name);
  return names;
}

class EveryCoverageMethod : public ::testing::TestWithParam<std::string_view> {
 protected:
  const CoverageMethod& method_ = find_coverage_method(GetParam());

  void expect_reach(std::vector<FloatTriangle> triangles, Window window, const std::string& what) {
    const auto too_large = static_cast<float>(method_.promise.max_side_px);
    std::erase_if(triangles, [&](const FloatTriangle& t) { return side_px(t.at) > too_large; });
    const Picture picture(std::move(triangles), window);
    const CoverageScore score = score_coverage(picture.by_floats, method_, picture.input);
    EXPECT_LE(score.worst_px, method_.promise.reach_px) << what;
    EXPECT_EQ(score.out_of_bounds, 0u) << what;
  }
};

TEST_P(EveryCoverageMethod, IsWrongOnlyWithinItsReach) {
  for (const Window window : {Window{120, 90}, {64, 48, 4020, 4030}, {4096, 3, 0, 50}, {3, 4096, 4000, 0}})
    for (const auto family : testing::kFloatFamilies)
      for (const std::uint64_t seed : {1u, 2u})
        expect_reach(hard_floats(family, 60, window, seed), window,
                     std::string(family) + " in " + std::to_string(window.width) + "x" +
                         std::to_string(window.height));
}

TEST_P(EveryCoverageMethod, IsWrongOnlyWithinItsReachOnTheGrid) {
  for (const auto family : testing::kFamilies)
    expect_reach(testing::as_floats(adversarial(family, 100, 160, 120, 4)), {160, 120}, std::string(family));
}

TEST_P(EveryCoverageMethod, LeavesNoGapOrDoubleHitInAMeshIfItSaysSo) {
  const CoveragePromise& promise = method_.promise;
  if (!promise.no_gaps && !promise.no_double_hits) return;
  for (const double cell_px : {9.0, 40.0, 150.0})
    for (const bool on_grid : {true, false}) {
      const double longest_px = 1.5 * cell_px;  // a cell and its jitter
      if ((promise.if_on_grid && !on_grid) || longest_px > promise.max_side_px) continue;
      auto mesh = float_triangles(jittered_grid({.width = 501, .height = 302}, cell_px, 31));
      if (on_grid) mesh = testing::as_floats(snapped(mesh));
      const Picture picture(std::move(mesh), {501, 302});
      ASSERT_TRUE(std::all_of(picture.by_floats.hits.begin(), picture.by_floats.hits.end(),
                              [](std::uint32_t hits) { return hits == 1; }));
      const CoverageScore score = score_coverage(picture.by_floats, method_, picture.input);
      EXPECT_TRUE(score.gaps == 0 || !promise.no_gaps) << cell_px << " px, on grid: " << on_grid;
      EXPECT_TRUE(score.double_hits == 0 || !promise.no_double_hits)
          << cell_px << " px, on grid: " << on_grid;
    }
}

TEST_P(EveryCoverageMethod, DiffersFromTheTruthSomewhereUnlessItIsExact) {
  std::uint64_t off_grid_truth = 0, off_float_truth = 0;
  for (const auto& c : coverage_cases()) {
    const Picture& picture = picture_of(c.name);
    std::vector<lab::Run> runs;
    method_.runs(picture.input, picture.window, runs);
    off_grid_truth += score_coverage(picture.by_grid, runs, picture.floats).errors();
    off_float_truth += score_coverage(picture.by_floats, runs, picture.floats).errors();
  }
  EXPECT_EQ(off_grid_truth == 0, method_.info.exact);
  EXPECT_GT(off_float_truth, 0u);
}

TEST_P(EveryCoverageMethod, IsWrongBySnappingAloneIfItIsExact) {
  if (!method_.info.exact) return;
  const auto expect_exact = [&](const Picture& picture, std::string_view what) {
    CoverageScore perfect{.triangles = picture.floats.size(), .covered = picture.by_grid.covered};
    std::vector<lab::Run> runs;
    method_.runs(picture.input, picture.window, runs);
    EXPECT_EQ(score_coverage(picture.by_grid, runs, picture.floats), perfect) << what;
    EXPECT_EQ(score_coverage(picture.by_floats, runs, picture.floats),
              score_coverage(picture.by_floats, picture.by_grid.runs, picture.floats))
        << what;
  };
  for (const auto& c : coverage_cases()) expect_exact(picture_of(c.name), c.name);
  for (const auto family : testing::kFamilies)
    expect_exact({testing::as_floats(adversarial(family, 120, 97, 71, 6)), {97, 71}}, family);
  for (const auto family : testing::kFloatFamilies)
    expect_exact({hard_floats(family, 120, {97, 71}, 7), {97, 71}}, family);
}

// Triangles of constant depth, so that the nearest is known without rounding.
TEST_P(EveryCoverageMethod, DrawsTheNearestOfItsOwnRuns) {
  constexpr int kWidth = 90, kHeight = 70;
  auto triangles = hard_floats("anywhere", 60, {kWidth, kHeight}, 3);
  for (auto& t : triangles) t.at.z01[1] = t.at.z01[2] = t.at.z01[0];
  const auto grid = snapped(triangles);
  const CoverageInput input{triangles, grid};
  std::vector<lab::Run> runs;
  method_.runs(input, {kWidth, kHeight}, runs);
  std::vector<std::uint32_t> expected(kWidth * kHeight, 0);  // payloads count from 1
  for (const lab::Run& run : runs)
    for (int x = run.x0; x < run.x1; ++x) {
      std::uint32_t& nearest = expected[static_cast<std::size_t>(run.y * kWidth + x)];
      const auto z = [&](std::uint32_t payload) { return triangles[payload - 1].at.z01[0]; };
      if (nearest == 0 || z(run.triangle + 1) < z(nearest)) nearest = run.triangle + 1;
    }
  Canvas canvas(kWidth, kHeight);
  for (const int threads : {1, 2, 1}) {
    method_.draw(input, canvas, threads);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        ASSERT_EQ(canvas.frame.payload_row(y)[x], expected[static_cast<std::size_t>(y * kWidth + x)])
            << x << ", " << y;
  }
}

TEST_P(EveryCoverageMethod, FindsTheSameFarFromTheOriginWhileItsNumbersHold) {
  // A square off the samples; every coordinate and every product is exact in every method's numbers.
  const auto square = [](float x, float y) {
    std::vector<FloatTriangle> list(
        2, {{{x + 2, x + 10, x + 10}, {y + 3, y + 3, y + 11}, {0.5f, 0.5f, 0.5f}}, 1});
    list[1].at.x_px[1] = x + 2, list[1].at.y_px[1] = y + 11;
    return list;
  };
  const Picture near(square(0, 0), {16, 16}), far(square(30000, 20000), {16, 16, 30000, 20000});
  const CoverageScore score = score_coverage(near.by_grid, method_, near.input);
  EXPECT_EQ(score_coverage(far.by_grid, method_, far.input), score);
  EXPECT_EQ(far.by_grid.covered, 64u);
}

TEST_P(EveryCoverageMethod, SaysWhatItIs) {
  for (const auto text : {method_.info.name, method_.info.idea, method_.info.source, method_.info.promise})
    EXPECT_FALSE(text.empty());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryCoverageMethod, ::testing::ValuesIn(method_names()),
                         [](const auto& param) { return testing::test_name(param); });

TEST(CoverageRegistry, HoldsEveryFileInTheFolderAndEveryBackendOnce) {
  std::multiset<std::string> expected, names;
  for (const auto& entry :
       std::filesystem::directory_iterator(EDGEWISE_SOURCE_DIR "/src/lab/coverage_methods"))
    if (entry.path().extension() == ".cpp") expected.insert(entry.path().stem());
  for (const auto& backend : backends()) expected.emplace(backend.name);
  for (const auto& method : coverage_methods()) names.emplace(method.info.name);
  EXPECT_EQ(names, expected);
}

TEST(CoverageRegistry, SuggestsTheNearestName) {
  EXPECT_THROW(find_coverage_case("drtk"), std::invalid_argument);
  try {
    find_coverage_method("float_el");
    FAIL() << "an unknown method was found";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'float_le'?"), std::string::npos) << error.what();
  }
}

TEST(CoverageCases, TheDrtkQuadShowsTheTieRules) {
  const Picture& quad = picture_of("drtk_quad");
  EXPECT_EQ(against_floats("float_le", quad).double_hits, 6u);
  EXPECT_EQ(against_floats("float_le", quad).gaps, 0u);
  EXPECT_EQ(against_floats("float_lt", quad).gaps, 6u);
  EXPECT_EQ(against_floats("float_lt", quad).double_hits, 0u);
  EXPECT_EQ(against_floats("float_top_left", quad).errors(), 0u);
}

TEST(CoverageCases, ASquareOnTheLatticeTiesAlongItsWholeDiagonal) {
  const Picture& square = picture_of("lattice_square");
  EXPECT_EQ(against_floats("float_le", square).double_hits, 64u);
  EXPECT_EQ(against_floats("float_lt", square).gaps, 64u);
  EXPECT_EQ(against_floats("float_top_left", square).errors(), 0u);
}

TEST(CoverageCases, FloatsOpenGapsInAFan) {
  const Picture& fan = picture_of("fan");
  for (const auto method : {"float_top_left", "float_snapped", "float_incremental"}) {
    EXPECT_GT(against_floats(method, fan).gaps, 0u) << method;
    EXPECT_GT(against_floats(method, fan).double_hits, 0u) << method;
  }
  EXPECT_GT(against_floats("float_incremental", fan).errors(),
            10 * against_floats("float_top_left", fan).errors());
}

TEST(CoverageCases, FinerSnappingIsLessWrong) {
  for (const auto name : {"fan", "mesh"}) {
    std::uint64_t coarser = ~std::uint64_t{0};
    for (const auto method : {"whole_pixel", "fixed_4", "fixed_8", "fixed_12", "fixed_16"}) {
      const std::uint64_t errors = against_floats(method, picture_of(name)).errors();
      EXPECT_LT(errors, coarser) << method << " in " << name;
      coarser = errors;
    }
  }
}

TEST(CoverageCases, TallSliversShowDrift) {
  const Picture& slivers = picture_of("tall_slivers");
  EXPECT_GT(against_floats("dda_16_16", slivers).errors(), 0u);
  EXPECT_EQ(against_floats("fixed_16", slivers).errors(), 0u);
  EXPECT_GT(against_floats("dda_rounded", slivers).double_hits, 1000u);
}

TEST(CoverageCases, LegsOf182PixelsWrap32Bits) {
  EXPECT_EQ(against_grid("fixed_8_int32", picture_of("legs_181")).errors(), 0u);
  const Picture& legs = picture_of("legs_182");
  EXPECT_EQ(against_grid("fixed_8_int32", legs).missing, legs.by_grid.covered);
}

TEST(CoverageCases, ATJunctionCracksAlikeInAllExactBackends) {
  const Picture &cracked = picture_of("t_junction"), &split = picture_of("t_junction_split");
  for (const auto& backend : backends()) {
    EXPECT_EQ(against_floats(backend.name, cracked).gaps, 199u) << backend.name;
    EXPECT_EQ(against_floats(backend.name, split).gaps, 0u) << backend.name;
    EXPECT_EQ(against_floats(backend.name, split).double_hits, 0u) << backend.name;
  }
}

TEST(CoverageCases, WholePixelVerticesLoseAndFlipSmallTriangles) {
  const Picture& small = picture_of("small_triangles");
  EXPECT_GT(against_floats("whole_pixel", small).double_hits, 0u);
  EXPECT_GT(against_floats("whole_pixel", small).errors(),
            10 * against_floats("fixed_4", small).errors() / 2);
}

TEST(CoverageCases, AnEdgeBesideItsSamplesBeatsDoubles) {
  const Picture& tie = picture_of("double_tie");
  EXPECT_EQ(against_floats("double_top_left", tie).missing, 64u);
  EXPECT_EQ(against_floats("double_top_left", tie).extra, 64u);
}

TEST(CoverageMethods, Dda1616WrapsPast32767Pixels) {
  const auto errors = [](int x0) {
    const auto x = static_cast<float>(x0);
    const Picture picture({{{{x + 1, x + 30, x + 5}, {1, 9, 30}, {0, 0, 0}}, 1}}, {32, 32, x0, 0});
    EXPECT_GT(picture.by_floats.covered, 100u);
    return against_floats("dda_16_16", picture).errors();
  };
  EXPECT_EQ(errors(32736), 0u);
  EXPECT_GT(errors(32768), 100u);
}

TEST(CoverageMethods, RefuseTrianglesBeyondTheGuardBandForBackends) {
  const std::vector<FloatTriangle> far{{{{0, 30, 5}, {1, 9, 30}, {0, 0, 0}}, 1}};
  const auto grid = snapped(far);
  std::vector<lab::Run> runs;
  EXPECT_THROW(find_coverage_method("tiled").runs({far, grid}, {16, 16, 20000, 0}, runs),
               std::invalid_argument);
}

// A triangle of 15 pixels and one of a single pixel in a 5 x 5 window at (10, 20), judged by hand.
class Score : public ::testing::Test {
 protected:
  const Picture picture_{{{{{11.0f, 17.1f, 11.0f}, {21.0f, 21.0f, 27.1f}, {0, 0, 0}}, 1},
                          {{{11.0f, 11.0f, 12.1f}, {23.0f, 24.0f, 23.0f}, {0, 0, 0}}, 2}},
                         {5, 5, 10, 20}};
  CoverageScore score(std::vector<lab::Run> runs) {
    return score_coverage(picture_.by_floats, std::move(runs), picture_.floats);
  }
};

TEST_F(Score, CountsEachErrorByItself) {
  const std::vector<lab::Run> truth{{0, 21, 11, 15}, {0, 22, 11, 15}, {0, 23, 11, 15}, {0, 24, 11, 14}};
  ASSERT_EQ(picture_.by_floats.runs.size(), 4u + 1u);
  ASSERT_TRUE(std::equal(truth.begin(), truth.end(), picture_.by_floats.runs.begin()));
  ASSERT_EQ(picture_.by_floats.covered, 16u);
  EXPECT_EQ(score(picture_.by_floats.runs).errors(), 0u);

  auto runs = truth;
  EXPECT_EQ(score(runs).missing, 1u);
  EXPECT_EQ(score(runs).gaps, 0u) << "the other triangle is there";
  runs[0].x1 = 13;
  EXPECT_EQ(score(runs).missing, 3u);
  EXPECT_EQ(score(runs).gaps, 2u);
  runs.push_back({1, 21, 13, 15});
  EXPECT_EQ(score(runs).gaps, 0u) << "the wrong triangle, but drawn";
  EXPECT_EQ(score(runs).extra, 2u);
  runs.push_back({0, 22, 11, 12});  // drawn twice for one triangle
  EXPECT_EQ(score(runs).double_hits, 1u);
  EXPECT_EQ(score(runs).extra, 2u);
  runs.push_back({0, 20, 10, 12});
  EXPECT_EQ(score(runs).extra, 4u);
  EXPECT_EQ(score(runs).out_of_box, 2u) << "the other triangle's; the last ones' squares touch the box";
  runs.push_back({1, 24, 14, 15});
  EXPECT_EQ(score(runs).out_of_box, 3u);
  runs.push_back({1, 30, 10, 15});
  runs.push_back({1, 21, 8, 10});
  EXPECT_EQ(score(runs).out_of_bounds, 7u);
  EXPECT_EQ(score(runs).extra, 5u);
  EXPECT_NEAR(score(runs).worst_px, 14.5 - 12.1, 1e-5);
}

TEST(Crossings, AreSampleRowsOrColumnsWhicheverIsMore) {
  const auto crossings = [](UnsnappedTriangle t) {
    return edge_crossings(std::vector{FloatTriangle{t, 1}}, {100, 50});
  };
  EXPECT_EQ(crossings({{0, 30, 30}, {0, 10, 0}, {}}), 30u + 10u + 30u);
  EXPECT_EQ(crossings({{0.6f, 30.4f, 30.4f}, {0, 10, 0}, {}}), 29u + 10u + 29u);
  EXPECT_EQ(crossings({{-100, 200, 200}, {20, 20, 20}, {}}), 100u + 100u) << "cut to the window";
  EXPECT_EQ(crossings({{-9, -2, -5}, {1, 8, 30}, {}}), 0u) << "outside";
}

TEST(Differences, AreWhatTheListsDoNotShare) {
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
    for (const Hit& hit : in_truth) ASSERT_EQ(missing.count(hit), 1u - in_drawn.count(hit));
    for (const Hit& hit : in_drawn) ASSERT_EQ(extra.count(hit), 1u - in_truth.count(hit));
    for (const Hit& hit : missing) ASSERT_EQ(in_truth.count(hit), 1u);
    for (const Hit& hit : extra) ASSERT_EQ(in_drawn.count(hit), 1u);
  }
}

TEST(DisjointGroups, KeepTrianglesThatTouchNoCommonPixelTogetherAndAllOthersApart) {
  const auto triangles = adversarial("tiny", 400, 80, 60, 2);
  std::set<std::uint32_t> seen;
  for (const auto& group : disjoint_groups(triangles, 80, 60)) {
    std::vector<int> used(80 * 60, 0);
    for (const std::uint32_t i : group) {
      EXPECT_TRUE(seen.insert(i).second);
      const auto box = contract::pixel_box(triangles[i], 80, 60);
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) EXPECT_EQ(used[static_cast<std::size_t>(y * 80 + x)]++, 0);
    }
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    EXPECT_EQ(seen.count(i) == 0, contract::pixel_box(triangles[i], 80, 60).empty());
}

}  // namespace
}  // namespace edgewise::lab

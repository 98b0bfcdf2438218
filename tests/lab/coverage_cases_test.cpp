// The small coverage scenes show the failures for which they were made, in coverage and in visible triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "edgewise/contract.h"
#include "lab/coverage/visible.h"
#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::against_floats;
using testing::cracks_of;
using testing::find_coverage_method;
using testing::Picture;
using testing::picture_of;

TEST(CoverageCases, TheDrtkQuadShowsTheTieRules) {
  const Picture& quad = picture_of("drtk_quad");
  EXPECT_EQ(cracks_of("float_le", quad).double_hits.size(), 6u);
  EXPECT_EQ(cracks_of("float_le", quad).gaps.size(), 0u);
  EXPECT_EQ(cracks_of("float_lt", quad).gaps.size(), 6u);
  EXPECT_EQ(cracks_of("float_lt", quad).double_hits.size(), 0u);
  for (const auto method : {"float_top_left", "float_equation", "float_equation_fma"})
    EXPECT_EQ(against_floats(method, quad).errors(), 0u) << method;
}

TEST(CoverageCases, FloatsOpenGapsInAFan) {
  const Picture& fan = picture_of("fan");
  for (const auto method : {"float_top_left", "float_equation_fma", "float_incremental"}) {
    EXPECT_GT(cracks_of(method, fan).gaps.size(), 0u) << method;
    EXPECT_GT(cracks_of(method, fan).double_hits.size(), 0u) << method;
  }
  EXPECT_GT(against_floats("float_incremental", fan).errors(),
            10 * against_floats("float_top_left", fan).errors());
  // Its neighbours compute exactly opposite values, unless they are fused.
  EXPECT_GT(against_floats("float_equation", fan).errors(), 0u);
  EXPECT_EQ(cracks_of("float_equation", fan).at_shared_edges(), 0u);
}

TEST(CoverageCases, AllBackendsLeaveTheSameGapsAtATJunction) {
  const Picture &cracked = picture_of("t_junction"), &split = picture_of("t_junction_split");
  for (const auto& backend : backends()) {
    const Cracks open = cracks_of(backend.name, cracked), closed = cracks_of(backend.name, split);
    EXPECT_EQ(open.t_gaps.size(), 199u) << backend.name;
    EXPECT_EQ(open.at_shared_edges(), 0u) << backend.name << ": the T-junction is no shared edge";
    EXPECT_EQ(closed.at_t_junctions() + closed.at_shared_edges(), 0u) << backend.name;
  }
}

TEST(CoverageCases, DoublesMisjudgeAnEdgeNextToItsSamples) {
  const Picture& tie = picture_of("double_tie");
  EXPECT_EQ(against_floats("double_top_left", tie).missing, 64u);
  EXPECT_EQ(against_floats("double_top_left", tie).extra, 64u);
}

// ---- Visible triangles and depths, checked by hand, by brute force, and by rule 6

VisibleTriangleScore visible_triangles_of(std::string_view method, const Picture& picture) {
  return VisibleTriangleJudge({{picture.window.width, picture.window.height}, picture.floats, picture.grid},
                              picture.cracks.surface(), 2)
      .score(find_coverage_method(method));
}

TEST(CoverageVisibleTriangles, TieRulesDecideTheDiagonalOfTheDrtkQuad) {
  const Picture& quad = picture_of("drtk_quad");
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

TEST(CoverageVisibleTriangles, DepthErrorsInUlpMatchBruteForce) {
  const Picture picture({{{{3.3f, 60.1f, 20.7f}, {2.9f, 13.2f, 58.8f}, {0.1f, 0.7f, 0.45f}}, 1}}, {64, 64});
  const CoverageMethod& method = find_coverage_method("float_top_left");
  Canvas canvas(64, 64);
  method.draw(picture.input, canvas, {});
  const FloatTruth truth(picture.floats[0].at);
  double most = 0.0, squares = 0.0;
  int count = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      if (!truth.covers(x, y)) continue;
      const double exact = truth.depth(x, y).get_d();
      const auto nearest = static_cast<float>(exact);
      const double drawn = double{canvas.depth[static_cast<std::size_t>(y * canvas.frame.stride() + x)]};
      const double ulp = double{std::nextafter(nearest, 1.0f)} - double{nearest};
      most = std::max(most, std::abs(drawn - exact) / ulp);
      squares += (drawn - exact) * (drawn - exact) / (ulp * ulp);
      ++count;
    }
  const VisibleTriangleScore score = visible_triangles_of("float_top_left", picture);
  EXPECT_GT(most, 0.5);
  EXPECT_NEAR(score.max_ulp, most, 1e-6);
  EXPECT_NEAR(score.rms_ulp, std::sqrt(squares / count), 1e-6);
  EXPECT_EQ(score.wrong_source, 0u);
}

}  // namespace
}  // namespace edgewise::lab

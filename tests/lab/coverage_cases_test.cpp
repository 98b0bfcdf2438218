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

TEST(CoverageCases, FinerSnappingMakesFewerErrors) {
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
  EXPECT_GT(cracks_of("dda_rounded", slivers).double_hits.size(), 900u);
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

TEST(CoverageCases, WholePixelVerticesLoseAndFlipSmallTriangles) {
  const Picture& small = picture_of("small_triangles");
  EXPECT_GT(cracks_of("whole_pixel", small).folds.size(), 0u);
  EXPECT_EQ(cracks_of("whole_pixel", small).at_shared_edges(), 0u);
  EXPECT_GT(against_floats("whole_pixel", small).errors(),
            10 * against_floats("fixed_4", small).errors() / 2);
}

TEST(CoverageCases, DoublesMisjudgeAnEdgeNextToItsSamples) {
  const Picture& tie = picture_of("double_tie");
  EXPECT_EQ(against_floats("double_top_left", tie).missing, 64u);
  EXPECT_EQ(against_floats("double_top_left", tie).extra, 64u);
}

// ---- Visible triangles, checked by hand and by rule 6

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

TEST(CoverageVisibleTriangles, OfBackendsAreExact) {
  for (const CoverageCase& c : coverage_cases()) {
    const Picture& picture = picture_of(c.name);
    const VisibleTriangleJudge judge({c.size, picture.floats, picture.grid}, picture.cracks.surface(), 2);
    for (const auto& backend : backends()) {
      const VisibleTriangleScore score = judge.score(find_coverage_method(backend.name));
      EXPECT_EQ(score.wrong_snapped, 0u) << backend.name << " in " << c.name;
      EXPECT_EQ(score.unexplained, 0u) << backend.name << " in " << c.name;
    }
  }
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

// Visible triangles of coverage methods, checked by hand and by rule 6.
#include <gtest/gtest.h>

#include "lab/coverage/visible.h"
#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::find_coverage_method;
using testing::Picture;
using testing::picture_of;

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

}  // namespace
}  // namespace edgewise::lab

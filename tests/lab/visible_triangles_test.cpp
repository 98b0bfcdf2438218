// Visible triangles and depths of coverage methods, checked by hand, by brute force, and by rule 6.
#include <gtest/gtest.h>

#include <cmath>

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

// The small coverage scenes show the failures for which they were made.
#include <gtest/gtest.h>

#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::against_floats;
using testing::against_grid;
using testing::Picture;
using testing::picture_of;

TEST(CoverageCases, TheDrtkQuadShowsTheTieRules) {
  const Picture& quad = picture_of("drtk_quad");
  EXPECT_EQ(against_floats("float_le", quad).double_hits, 6u);
  EXPECT_EQ(against_floats("float_le", quad).gaps, 0u);
  EXPECT_EQ(against_floats("float_lt", quad).gaps, 6u);
  EXPECT_EQ(against_floats("float_lt", quad).double_hits, 0u);
  EXPECT_EQ(against_floats("float_top_left", quad).errors(), 0u);
}

TEST(CoverageCases, TheDiagonalOfALatticeSquareConsistsOfTies) {
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
  EXPECT_GT(against_floats("dda_rounded", slivers).double_hits, 1000u);
}

TEST(CoverageCases, LegsOf182PixelsWrap32Bits) {
  EXPECT_EQ(against_grid("fixed_8_int32", picture_of("legs_181")).errors(), 0u);
  const Picture& legs = picture_of("legs_182");
  EXPECT_EQ(against_grid("fixed_8_int32", legs).missing, legs.by_grid.covered);
}

// Scores only a few rows at the top, where the triangles are widest, since the pictures are large.
TEST(CoverageCases, LegsOf2897PixelsWrap32BitsWithFourSubpixelBits) {
  const auto legs = [](float px) {
    return std::vector<FloatTriangle>{{{{0, px, 0}, {0, 0, px}, {0.5f, 0.5f, 0.5f}}, 1}};
  };
  const Window rows{2900, 8};
  const Picture holds(legs(2896), rows), wraps(legs(2897), rows);
  EXPECT_EQ(against_grid("fixed_4_int32", holds).errors(), 0u);
  EXPECT_EQ(against_grid("fixed_4_int32", wraps).missing, wraps.by_grid.covered);
  EXPECT_EQ(against_grid("fixed_4", wraps).errors(), 0u);
}

TEST(CoverageCases, AllBackendsLeaveTheSameGapsAtATJunction) {
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

TEST(CoverageCases, DoublesMisjudgeAnEdgeNextToItsSamples) {
  const Picture& tie = picture_of("double_tie");
  EXPECT_EQ(against_floats("double_top_left", tie).missing, 64u);
  EXPECT_EQ(against_floats("double_top_left", tie).extra, 64u);
}

}  // namespace
}  // namespace edgewise::lab

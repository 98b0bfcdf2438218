// The parts that triangles are cut into to be binned: all of them, once, in parts that take about as long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "edgewise/contract.h"
#include "raster/shares.h"

namespace edgewise {
namespace {

constexpr CellGrid kGrid{1024, 1024, 6, 6};

// Its box is a square of so many pixels.
ScreenTriangle of_side(int px) {
  ScreenTriangle t{};
  t.x_sub[1] = t.y_sub[2] = px * contract::kSub;
  return t;
}
// So many of them, the last of which are of another side.
std::vector<ScreenTriangle> triangles(std::size_t count, int px, std::size_t last, int last_px) {
  std::vector<ScreenTriangle> out(count, of_side(px));
  std::fill(out.end() - static_cast<std::ptrdiff_t>(last), out.end(), of_side(last_px));
  return out;
}
std::vector<std::size_t> bounds(const std::vector<ScreenTriangle>& triangles, std::size_t parts) {
  Shares shares;
  shares.cut(triangles, kGrid, parts);
  return {shares.bounds().begin(), shares.bounds().end()};
}
using Bounds = std::vector<std::size_t>;

TEST(Shares, AreEqualWhereTrianglesAreFewOrAlike) {
  EXPECT_EQ(bounds({}, 3), (Bounds{0, 0, 0, 0}));
  EXPECT_EQ(bounds(triangles(5, 4, 0, 4), 2), (Bounds{0, 2, 5}));
  EXPECT_EQ(bounds(triangles(10'000, 1, 5'000, 8), 2), (Bounds{0, 5'000, 10'000}));
  EXPECT_EQ(bounds(triangles(600'001, 4, 300'000, 4), 3), (Bounds{0, 200'000, 400'000, 600'001}));
  EXPECT_EQ(bounds(triangles(400'000, 4, 1'000, 8), 2), (Bounds{0, 200'000, 400'000}));
}

// 16 + 1 for a pixel, 16 + 64 for 8 x 8.
TEST(Shares, AreShorterWhereTrianglesTakeLonger) {
  const std::size_t half = 250'000;
  const Bounds cut = bounds(triangles(2 * half, 1, half, 8), 2);
  const double expected = static_cast<double>(half) * (1.0 + (80.0 - 17.0) / 2.0 / 80.0);
  EXPECT_NEAR(static_cast<double>(cut[1]), expected, 500.0);
  EXPECT_EQ(cut[0], 0u);
  EXPECT_EQ(cut[2], 2 * half);
}

// As soon as the last one outweighs all others, these are one part, and parts may be empty.
TEST(Shares, HoldEachTriangleOnceWhateverTheWeights) {
  constexpr CellGrid kFine{16384, 16384, 2, 2};
  auto all = triangles(1'000'000, 1, 0, 1);
  for (std::size_t i = all.size() - 1'000; i < all.size(); ++i) all[i] = of_side(16384);
  Shares shares;
  shares.cut(all, kFine, 5);
  const auto bounds = shares.bounds();
  ASSERT_EQ(bounds.size(), 6u);
  EXPECT_EQ(bounds.front(), 0u);
  EXPECT_EQ(bounds.back(), all.size());
  EXPECT_TRUE(std::is_sorted(bounds.begin(), bounds.end()));
  EXPECT_GT(bounds[1], all.size() - 1'500);
}

}  // namespace
}  // namespace edgewise

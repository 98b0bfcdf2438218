// The work partition of triangles for binning: each triangle is in one part, and the parts take about the
// same time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "edgewise/contract.h"
#include "raster/binning/work_partition.h"

namespace edgewise {
namespace {

constexpr CellGrid kGrid{1024, 1024, 6, 6};

// A triangle whose bounding box is a square of `px`.
ScreenTriangle of_side(int px) {
  ScreenTriangle t{};
  t.x_sub[1] = t.y_sub[2] = px * contract::kSub;
  return t;
}
// `count` triangles of `px`, of which the last `last` have `last_px` instead.
std::vector<ScreenTriangle> triangles(std::size_t count, int px, std::size_t last, int last_px) {
  std::vector<ScreenTriangle> out(count, of_side(px));
  std::fill(out.end() - static_cast<std::ptrdiff_t>(last), out.end(), of_side(last_px));
  return out;
}
std::vector<std::size_t> bounds(const std::vector<ScreenTriangle>& triangles, std::size_t parts) {
  WorkPartition partition;
  StoredTriangles source(triangles);
  partition.cut_by_work(source, kGrid, true, parts);
  return {partition.bounds().begin(), partition.bounds().end()};
}
using Bounds = std::vector<std::size_t>;

TEST(WorkPartition, HasEqualPartsForFewOrEqualTriangles) {
  EXPECT_EQ(bounds({}, 3), (Bounds{0, 0, 0, 0}));
  EXPECT_EQ(bounds(triangles(5, 4, 0, 4), 2), (Bounds{0, 2, 5}));
  EXPECT_EQ(bounds(triangles(10'000, 1, 5'000, 8), 2), (Bounds{0, 5'000, 10'000}));
  EXPECT_EQ(bounds(triangles(900'001, 4, 300'000, 4), 3), (Bounds{0, 300'000, 600'000, 900'001}));
  EXPECT_EQ(bounds(triangles(400'000, 4, 10'000, 8), 2), (Bounds{0, 200'000, 400'000}));
}

// The cost is 16 + 1 for one pixel, 16 + 64 for 8 x 8.
TEST(WorkPartition, HasShorterPartsOfCostlyTriangles) {
  const std::size_t half = 250'000;
  const Bounds cut = bounds(triangles(2 * half, 1, half, 8), 2);
  const double expected = static_cast<double>(half) * (1.0 + (80.0 - 17.0) / 2.0 / 80.0);
  EXPECT_NEAR(static_cast<double>(cut[1]), expected, 500.0);
  EXPECT_EQ(cut[0], 0u);
  EXPECT_EQ(cut[2], 2 * half);
}

// Inputs that become no triangle cost 8, others 16 and more.
TEST(WorkPartition, HasLongerPartsOfInputsWithoutTriangles) {
  static constexpr std::size_t half = 250'000;
  class HalfEmpty final : public TriangleSource {
   public:
    std::size_t size() const override { return 2 * half; }
    std::span<const ScreenTriangle> make(int, std::size_t, std::size_t) override { return {}; }
    std::span<const ScreenTriangle> probe(std::size_t input) override {
      return {&triangle, input < half ? 0u : 1u};
    }
    ScreenTriangle triangle = of_side(9);
  };
  HalfEmpty source;
  WorkPartition partition;
  for (const bool masks : {false, true}) {
    partition.cut_by_work(source, kGrid, masks, 2);
    EXPECT_NEAR(static_cast<double>(partition.bounds()[1]), 1.25 * half, 500.0);
  }
}

// Boxes of 8 x 8 px cost 16 + 64, larger and empty ones 16.
TEST(WorkPartition, CountsLargeTrianglesAsCheap) {
  const std::size_t half = 250'000;
  const Bounds cut = bounds(triangles(2 * half, 8, half, 9), 2);
  EXPECT_NEAR(static_cast<double>(cut[1]), static_cast<double>(half) * (80.0 + 16.0) / 2.0 / 80.0, 500.0);
  EXPECT_EQ(bounds(triangles(2 * half, 0, half, 9), 2)[1], half);
}

// A tenth of the triangles costs five times as much as the others.
TEST(WorkPartition, HasEqualPartsInRandomOrder) {
  auto all = triangles(1'000'000, 1, 100'000, 8);
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(all.begin(), all.end(), random);
    EXPECT_EQ(bounds(all, 2)[1], all.size() / 2);
  }
}

TEST(WorkPartition, HoldsEachTriangleOnce) {
  const Bounds cut = bounds(triangles(2'000'000, 1, 200'000, 8), 4);
  ASSERT_EQ(cut.size(), 5u);
  EXPECT_EQ(cut.front(), 0u);
  EXPECT_EQ(cut.back(), 2'000'000u);
  EXPECT_TRUE(std::is_sorted(cut.begin(), cut.end()));
  EXPECT_GT(cut[1], 600'000u);
}

}  // namespace
}  // namespace edgewise

// Binning: a cell's list holds every triangle that covers one of its samples, once and in order. Of the
// triangles that span few cells, it holds few others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/triangle_source.h"
#include "edgewise/contract.h"
#include "edgewise/simd_target.h"
#include "lab/cases/exact_spans.h"
#include "raster/binning/bins.h"
#include "support.h"

namespace edgewise::testing {
namespace {

using namespace contract;

class BinsOnTarget : public ::testing::TestWithParam<SimdTarget> {
 protected:
  // The lists of all cells.
  std::vector<std::vector<std::uint32_t>> lists(std::span<const ScreenTriangle> triangles,
                                                const CellGrid& grid) {
    StoredTriangles stored(triangles);
    EXPECT_TRUE(bins_.build(stored, grid, 2, GetParam(), false));
    std::vector<std::vector<std::uint32_t>> out(static_cast<std::size_t>(grid.cells()));
    for (int cell = 0; cell < grid.cells(); ++cell)
      bins_.for_each_segment(cell, [&](const Bins::Segment& segment) {
        auto& list = out[static_cast<std::size_t>(cell)];
        list.insert(list.end(), segment.indices.begin(), segment.indices.end());
      });
    return out;
  }
  Bins bins_;
};

// In 1/256 px.
ScreenTriangle triangle(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1, std::int32_t x2,
                        std::int32_t y2) {
  return coarse({{x0, x1, x2}, {y0, y1, y2}, {}, 0});
}

// Makes so many equal triangles of eight inputs.
class Equal final : public TriangleSource {
 public:
  Equal(std::size_t inputs, std::size_t of_eight)
      : inputs_(inputs),
        of_eight_(of_eight),
        made_(kInputsAtOnce * of_eight, triangle(0, 0, 9000, 0, 0, 9000)) {}
  std::size_t size() const override { return inputs_; }
  std::span<const ScreenTriangle> make(int, std::size_t begin, std::size_t end) override {
    return std::span(made_).first(end * of_eight_ / 8 - begin * of_eight_ / 8);
  }

 private:
  std::size_t inputs_, of_eight_;
  std::vector<ScreenTriangle> made_;
};

// Up to twice its inputs; after a source that made more, up to the seven that clipping makes of one.
TEST(Bins, HaveRoomForASourcesTriangles) {
  for (const int threads : {1, 2, 3}) {
    Bins bins;
    const auto fits = [&](std::size_t of_eight) {
      Equal source(100'000, of_eight);
      return bins.build(source, {64, 64, 6, 6}, threads, resolve(SimdTarget::best), true);
    };
    const auto kept = [&] {
      std::size_t count = 0;
      bins.for_each_segment(0, [&](const Bins::Segment& segment) { count += segment.indices.size(); });
      return count;
    };
    EXPECT_TRUE(fits(16));
    EXPECT_EQ(kept(), 200'000u);
    EXPECT_FALSE(fits(32));
    EXPECT_TRUE(fits(56));
    EXPECT_EQ(kept(), 700'000u);
  }
}

// Triangles with edges in all directions that pass within a few sub-units of the samples at the corner of
// four cells.
std::vector<ScreenTriangle> around_a_corner(int corner_px, std::int32_t reach_sub, int count) {
  Random random(7);
  const auto within = [&](std::int32_t reach) {
    return static_cast<std::int32_t>(random.below(2 * static_cast<std::uint64_t>(reach) + 1)) - reach;
  };
  const std::int32_t corner = corner_px * Coarse::kSub;
  std::vector<ScreenTriangle> out;
  for (int i = 0; i < count; ++i) {
    const std::int32_t dx = within(reach_sub), dy = within(reach_sub);
    const std::int32_t x = corner + (i & 4 ? Coarse::kHalf : -Coarse::kHalf) + within(2);
    const std::int32_t y = corner + (i & 8 ? Coarse::kHalf : -Coarse::kHalf) + within(2);
    const std::int32_t far_x = corner + within(reach_sub), far_y = corner + within(reach_sub);
    ScreenTriangle t{{x - dx, x + dx + within(2), far_x}, {y - dy, y + dy + within(2), far_y}, {}, 0};
    if (i % 2 != 0) std::swap(t.x_q15[0], t.x_q15[2]), std::swap(t.y_q15[0], t.y_q15[2]);
    if (i % 3 == 0) t.x_q15[2] = x + within(3), t.y_q15[2] = y + within(3);  // a sliver
    out.push_back(coarse(t));
  }
  return out;
}

void expect_no_loss(const std::vector<ScreenTriangle>& triangles, const CellGrid& grid,
                    const std::vector<std::vector<std::uint32_t>>& lists) {
  std::vector<std::size_t> next(lists.size(), 0);
  for (const auto& list : lists)
    for (std::size_t i = 1; i < list.size(); ++i) ASSERT_LT(list[i - 1], list[i]);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto expect_in = [&](int cell) {
      const auto& list = lists[static_cast<std::size_t>(cell)];
      std::size_t& at = next[static_cast<std::size_t>(cell)];
      while (at < list.size() && list[at] < i) ++at;
      EXPECT_TRUE(at < list.size() && list[at] == i) << "triangle " << i << " is not in cell " << cell;
    };
    lab::for_each_span(triangles[i], grid.width, grid.height, [&](int y, int begin, int end) {
      begin = std::max(begin, grid.x0);
      if (y < grid.y0 || begin >= end) return;
      const int row = (y >> grid.cell_h_log2) * grid.columns();
      for (int column = begin >> grid.cell_w_log2; column <= (end - 1) >> grid.cell_w_log2; ++column)
        expect_in(row + column);
    });
  }
}

TEST_P(BinsOnTarget, LoseNoTriangleAndHoldNoneWithoutASampleBoxInTheDrawnPart) {
  for (const auto& [x0, y0] : {std::pair{0, 0}, {130, 90}})
    for (const int log2 : {3, 4, 6})
      for (const std::string_view family : kFamilies) {
        const CellGrid grid{200, 150, log2, log2, x0, y0};
        const auto triangles = adversarial(family, full_size() ? 20'000 : 2'000, grid.width, grid.height, 11);
        SCOPED_TRACE(std::string(family) + ", cells of " + std::to_string(1 << log2));
        const auto found = lists(triangles, grid);
        expect_no_loss(triangles, grid, found);
        for (const auto& list : found)
          for (const std::uint32_t i : list) {
            const PixelBox box = pixel_box(triangles[i], grid.width, grid.height);
            ASSERT_FALSE(box.empty() || box.x1 <= grid.x0 || box.y1 <= grid.y0) << i;
          }
      }
}

TEST_P(BinsOnTarget, LoseNoTriangleNearACellCorner) {
  const int count = full_size() ? 400'000 : 40'000;
  for (const int log2 : {3, 6, 13}) {  // 13: edges of the maximum length
    const CellGrid grid{2 << log2, 2 << log2, log2, log2};
    const auto triangles =
        around_a_corner(1 << log2, ((1 << log2) - 4) * Coarse::kSub, log2 == 13 ? count / 1000 : count);
    SCOPED_TRACE("cells of " + std::to_string(1 << log2));
    expect_no_loss(triangles, grid, lists(triangles, grid));
  }
}

TEST_P(BinsOnTarget, RejectUncoveredCellsOfLargeBoxes) {
  const CellGrid grid{64, 64, 4, 4};
  std::vector<ScreenTriangle> triangles;  // in the four corners of the image
  for (const auto& [x, far_x] : {std::pair{0, 62 * Coarse::kSub}, {64 * Coarse::kSub, 2 * Coarse::kSub}})
    for (const auto& [y, far_y] : {std::pair{0, 62 * Coarse::kSub}, {64 * Coarse::kSub, 2 * Coarse::kSub}})
      triangles.push_back(triangle(x, y, far_x, y, x, far_y));
  const auto found = lists(triangles, grid);
  expect_no_loss(triangles, grid, found);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      std::vector<std::uint32_t> expected;  // the hypotenuses end 62 px from the corners
      for (const std::uint32_t i : {0u, 1u, 2u, 3u})
        if ((i & 2 ? 3 - column : column) + (i & 1 ? 3 - row : row) < 4) expected.push_back(i);
      EXPECT_EQ(found[static_cast<std::size_t>(row * 4 + column)], expected);
    }
}

INSTANTIATE_TEST_SUITE_P(All, BinsOnTarget, ::testing::ValuesIn(supported_targets()),
                         [](const auto& target) { return std::string(name_of(target.param)); });

}  // namespace
}  // namespace edgewise::testing

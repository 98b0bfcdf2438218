// Drawing in tiles: the tasks, and which stores copy a tile to the frame. Every backend test checks that
// these choices change no picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "raster/kernels.h"
#include "raster/policy.h"
#include "raster/traversals.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(TileStore, IsTheCallersChoiceOrStreamingIfTheFrameIsClearedOnOneThread) {
  constexpr int kSide = 2 * contract::kMaxTile, kLeg = 2000 * contract::kPixel_q15;
  const ScreenTriangle all_over{{0, kLeg, 0}, {0, 0, kLeg}, {9, 9, 9}, 5};
  Framebuffer frame(kSide, kSide);
  static std::atomic<int> streamed;
  const auto tiles_streamed = [&](TileStore store, bool clear, int threads) {
    streamed = 0;
    const auto count_streamed = [](SimdTarget) -> TileKernel {
      return [](const TileTask& task) { streamed += task.streaming; };
    };
    tile_backend(count_streamed, {.tile_store = store})
        ->draw({&all_over, 1}, frame.view(), {.clear = clear}, {threads, 64});
    return streamed.load();
  };
  for (const bool clear : {true, false})
    for (const int threads : {1, 2}) {
      EXPECT_EQ(tiles_streamed(TileStore::cached, clear, threads), 0);
      EXPECT_EQ(tiles_streamed(TileStore::streaming, clear, threads), 4);
      EXPECT_EQ(tiles_streamed(TileStore::automatic, clear, threads), clear && threads == 1 ? 4 : 0);
    }
}

TEST(TileStore, AutomaticallyStreamsLargeFrames) {
  for (const int threads : {1, 2}) {
    EXPECT_TRUE(tiles_are_streamed(is_large(201, 300), threads));
    EXPECT_EQ(tiles_are_streamed(is_large(200, 300), threads), threads == 1);
  }
}

// Tiles of which the part holds a pixel have tasks. If nothing is cleared, only those with triangles have.
TEST(TileTasks, AreThoseOfThePart) {
  constexpr int kSide = contract::kMaxTile, kLeg = 2000 * contract::kPixel_q15;
  const ScreenTriangle all_over{{0, kLeg, 0}, {0, 0, kLeg}, {9, 9, 9}, 5};
  Framebuffer frame(5 * kSide, 5 * kSide);
  const auto cells = [&](std::span<const ScreenTriangle> triangles, int x1, int y1, int x0, int y0,
                         bool clear) {
    FramePart part{.frame = frame.view(), .x0 = x0, .y0 = y0, .clear = clear};
    part.frame.width = x1, part.frame.height = y1;
    const CellGrid grid{x1, y1, 6, 6, x0, y0};
    Bins bins;
    StoredTriangles stored(triangles);
    EXPECT_TRUE(bins.build(stored, grid, 1, resolve(SimdTarget::best), true));
    std::vector<TileJob> tasks;
    list_jobs(bins, grid, part, 1, false, tasks);
    std::vector<int> list;
    for (const TileJob& task : tasks) list.push_back(task.cell);
    return list;
  };
  constexpr int kClear = TileJob::kInFrame;
  const std::span<const ScreenTriangle> none, one(&all_over, 1);
  using Cells = std::vector<int>;
  EXPECT_EQ(cells(one, 2 * kSide + 1, 2 * kSide, kSide - 1, kSide - 1, true), (Cells{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(cells(one, 2 * kSide, 2 * kSide + 1, kSide, kSide, true), (Cells{3, 5}));
  EXPECT_EQ(cells(none, 2 * kSide, 2 * kSide + 1, kSide, kSide, true), (Cells{kClear, kClear}));
  EXPECT_EQ(cells(one, 2 * kSide, 2 * kSide, 0, 0, false), (Cells{0, 1, 2, 3}));
  EXPECT_EQ(cells(none, 2 * kSide, 2 * kSide, 0, 0, false), Cells{});
}

// About 4 strips per thread in all; a row has as many as its height and this allow, at least 8 px each.
TEST(TileTasks, FillEmptyTilesInEvenStrips) {
  Bins bins;
  std::vector<TileJob> tasks;
  for (const int size_log2 : {4, 5, 6})
    for (int height = 1; height <= 3 << size_log2; ++height)
      for (int threads = 1; threads <= 24; ++threads) {
        const CellGrid grid{100, height, size_log2, size_log2};
        StoredTriangles none({});
        ASSERT_TRUE(bins.build(none, grid, 1, resolve(SimdTarget::best), false));
        list_jobs(bins, grid, {}, threads, false, tasks);
        const std::string where = std::to_string(1 << size_log2) + " px, height " + std::to_string(height) +
                                  ", threads " + std::to_string(threads);
        int y = 0;
        std::vector<std::vector<int>> heights(static_cast<std::size_t>(grid.rows()));
        for (const TileJob& task : tasks) {
          ASSERT_EQ(task.cell, TileJob::kInFrame);
          ASSERT_EQ(task.y0, y) << where;
          ASSERT_EQ(task.row, y >> size_log2) << where;
          y = task.y1;
          heights[static_cast<std::size_t>(task.row)].push_back(task.y1 - task.y0);
        }
        ASSERT_EQ(y, height) << where;
        for (const std::vector<int>& strips : heights) {
          const auto [least, most] = std::ranges::minmax(strips);
          const int row_px = std::accumulate(strips.begin(), strips.end(), 0);
          ASSERT_LE(most - least, 1) << where;
          ASSERT_EQ(strips.size(), std::max(1, std::min(4 * threads / grid.rows(), row_px / 8))) << where;
        }
      }
}

}  // namespace
}  // namespace edgewise

// Selection of the stores that copy a tile to the frame. Every backend test checks that cached and streaming
// stores write the same bits (lab::kTileOptions).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "core/llc.h"
#include "lab/measure.h"
#include "raster/tile_task.h"
#include "raster/tiles.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(TileStore, IsCachedOnlyInFramesThatFitHalfTheCache) {
  constexpr std::size_t kLlc = 8 << 20;
  using enum TileContent;
  for (const TileContent content : {nothing, few, many})
    for (const int threads : {1, 2})
      EXPECT_EQ(tile_store_for(content, 10, threads, kLlc / 2 + 1, kLlc), TileStore::streaming);
  for (const std::size_t triangles : {std::size_t{10}, std::size_t{1} << 20})
    for (const int threads : {1, 2}) {
      const auto is_cached = [&](TileContent content) {
        return tile_store_for(content, triangles, threads, kLlc / 2, kLlc) == TileStore::cached;
      };
      EXPECT_TRUE(is_cached(nothing));
      EXPECT_EQ(is_cached(few), triangles == 10);
      EXPECT_EQ(is_cached(many), triangles == 10 && threads == 2);
    }
}

TEST(TileStore, IsTheCallersChoiceIfItMakesOne) {
  const int side = 4 * contract::kMaxTile;
  const auto triangles = testing::adversarial("cloud", 400, side / 2 - 1, side, 5);
  Framebuffer frame(side, side);
  static std::atomic<int> streamed, drawn;
  const TileKernel count = [](const TileTask& task) {
    streamed += task.streaming;
    ++drawn;
  };
  const auto tiles_streamed = [&](TileStore store, int threads, std::size_t count_triangles = 400) {
    streamed = drawn = 0;
    TileScratch scratch;
    StoredTriangles first{std::span(triangles).first(count_triangles)};
    draw_in_tiles(first, frame.view(), 0, {threads, 64, resolve(SimdTarget::best)},
                  {.coverage_masks = false, .tile_store = store}, scratch, count);
    return streamed.load();
  };
  EXPECT_EQ(tiles_streamed(TileStore::cached, 1), 0);
  ASSERT_GE(llc_bytes(), std::size_t{1} << 20) << "half of it holds the frame";
  EXPECT_EQ(tiles_streamed(TileStore::automatic, 2), 0);
  EXPECT_GT(tiles_streamed(TileStore::streaming, 2), 0);
  EXPECT_EQ(streamed, drawn);
  EXPECT_GT(tiles_streamed(TileStore::automatic, 1), 0);
  EXPECT_EQ(tiles_streamed(TileStore::automatic, 1, 30), 0) << "few triangles in each tile";
  EXPECT_GT(drawn, 0);
  EXPECT_LT(drawn, 16) << "empty tiles do not reach the kernel";
}

TEST(TileTasks, FillTheEmptyTilesOfARowTogether) {
  const int side = 16 * contract::kMaxTile;
  const ScreenTriangle corner{{0, 9000, 0}, {0, 0, 9000}, {9, 9, 9}, 5};
  Framebuffer frame(side, side);
  static std::atomic<int> drawn;
  const TileKernel count = [](const TileTask&) { ++drawn; };
  const auto tasks = [&](int height) {
    drawn = 0;
    TileScratch scratch;
    StoredTriangles stored({&corner, 1});
    FrameView view = frame.view();
    view.height = height;
    draw_in_tiles(stored, view, 0, {2, 64, resolve(SimdTarget::best)}, {}, scratch, count);
    return scratch.list.tasks().size();
  };
  const int tiles_with_triangles = 1;
  EXPECT_EQ(tasks(side), tiles_with_triangles + 16u) << "and one for the empty tiles of each row";
  EXPECT_EQ(drawn, tiles_with_triangles);
  EXPECT_EQ(tasks(64), tiles_with_triangles + 8u) << "a single row's empty tiles, by 8 px of height";
}

// About 4 strips per thread in all; a row has as many as its height and this allow, at least 8 px each.
TEST(TileTasks, FillEmptyTilesInEvenStrips) {
  Bins bins;
  TileList list;
  for (const int size_log2 : {4, 5, 6})
    for (int height = 1; height <= 3 << size_log2; ++height)
      for (int threads = 1; threads <= 24; ++threads) {
        const CellGrid grid{100, height, size_log2, size_log2};
        bins.build(std::span<const ScreenTriangle>(), grid, 1, resolve(SimdTarget::best),
                   Bins::Small::as_indices);
        list.build(bins, grid, threads);
        const std::string where = std::to_string(1 << size_log2) + " px, height " + std::to_string(height) +
                                  ", threads " + std::to_string(threads);
        int y = 0;
        std::vector<std::vector<int>> heights(static_cast<std::size_t>(grid.rows()));
        for (const TileList::Task& task : list.tasks()) {
          ASSERT_EQ(task.cell, TileList::kEmptyTiles);
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

TEST(TileTasks, AreTakenOneByOneIfTheyAreFew) {
  EXPECT_EQ(tasks_at_once(256, 2), 4);
  EXPECT_EQ(tasks_at_once(64, 2), 2);
  EXPECT_EQ(tasks_at_once(63, 2), 1);
  EXPECT_EQ(tasks_at_once(1, 64), 1);
}

// The first tile waits for the second in vain, because the same thread draws it next. The number of tiles is
// no multiple of four.
TEST(TileTasks, DrawEachTileOnceInFours) {
  constexpr int kColumns = 15, kRows = 9, kLeg = 2000 * contract::kSub;
  const ScreenTriangle all_over{{0, kLeg, 0}, {0, 0, kLeg}, {9, 9, 9}, 5};
  Framebuffer frame(kColumns * contract::kMaxTile, kRows * contract::kMaxTile);
  std::vector<std::atomic<int>> drawn(kColumns * kRows);
  bool met = false;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  TileScratch scratch;
  StoredTriangles stored({&all_over, 1});
  draw_in_tiles(stored, frame.view(), 0, {2, 64, resolve(SimdTarget::best)}, {}, scratch,
                [&](const TileTask& task) {
                  while (task.cell == 0 && !met && std::chrono::steady_clock::now() < deadline)
                    met = drawn[1] > 0;
                  ++drawn[static_cast<std::size_t>(task.cell)];
                });
  EXPECT_TRUE(std::ranges::all_of(drawn, [](const auto& n) { return n == 1; }));
  EXPECT_FALSE(met);
}

// Empty tiles at the right and lower end, beside and between tiles with triangles, by either store.
TEST(TileStore, FillsEveryEmptyTile) {
  const auto corner = [](int x, int y, std::uint32_t payload) {
    const int x0 = x * contract::kSub, y0 = y * contract::kSub, size = 8 * contract::kSub;
    return ScreenTriangle{{x0, x0 + size, x0}, {y0, y0, y0 + size}, {9, 9, 9}, payload};
  };
  const std::vector<ScreenTriangle> triangles{corner(70, 3, 5), corner(270, 3, 6), corner(130, 130, 7)};
  for (const TileStore store : {TileStore::cached, TileStore::streaming})
    for (const int width : {333, 320}) {
      Framebuffer expected(width, 200), frame(width, 200);
      backends().front().make()->draw(triangles, expected.view(), 42, {});
      lab::poison(frame);
      TileScratch scratch;
      StoredTriangles stored(triangles);
      draw_in_tiles(stored, frame.view(), 42, {2, 64, resolve(SimdTarget::best)}, {.tile_store = store},
                    scratch, tile_kernel(resolve(SimdTarget::best)));
      testing::expect_same(expected, frame, std::to_string(width) + " px wide");
    }
}

}  // namespace
}  // namespace edgewise

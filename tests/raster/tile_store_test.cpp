// Selection of the stores that copy a tile to the frame. Every backend test checks that cached and streaming
// stores write the same bits (lab::kTileOptions).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "raster/llc.h"
#include "lab/cases/frame_comparison.h"
#include "raster/kernels.h"
#include "raster/policy.h"
#include "raster/tiles.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(TileStore, IsCachedOnlyInFramesThatFitHalfTheCache) {
  constexpr std::size_t kLlc = 8 << 20;
  using enum TileContent;
  for (const TileContent content : {nothing, few, many})
    for (const int threads : {1, 2})
      EXPECT_EQ(tile_store_for(content, 400, threads, kLlc / 2 + 1, kLlc), TileStore::streaming);
  for (const std::size_t bytes : {kL2Bytes, kL2Bytes + 1})
    for (const int threads : {1, 2}) {
      const auto is_cached = [&](TileContent content) {
        return tile_store_for(content, bytes, threads, kLlc / 2, kLlc) == TileStore::cached;
      };
      EXPECT_TRUE(is_cached(nothing));
      EXPECT_EQ(is_cached(few), bytes == kL2Bytes);
      EXPECT_EQ(is_cached(many), bytes == kL2Bytes && threads == 2);
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
  const auto tiles_streamed = [&](TileStore store, int threads, std::size_t count_triangles = 400,
                                  bool clear = true) {
    streamed = drawn = 0;
    TileScratch scratch;
    StoredTriangles first{std::span(triangles).first(count_triangles)};
    draw_in_tiles(first, {.frame = frame.view(), .clear = clear}, {threads, 64, resolve(SimdTarget::best)},
                  {.coverage_masks = false, .tile_store = store}, scratch, count);
    return streamed.load();
  };
  EXPECT_EQ(tiles_streamed(TileStore::cached, 1), 0);
  ASSERT_GE(llc_bytes(), std::size_t{1} << 20) << "half of it holds the frame";
  EXPECT_EQ(tiles_streamed(TileStore::automatic, 2), 0);
  EXPECT_GT(tiles_streamed(TileStore::streaming, 2), 0);
  EXPECT_EQ(streamed, drawn);
  EXPECT_GT(tiles_streamed(TileStore::automatic, 1), 0);
  EXPECT_EQ(tiles_streamed(TileStore::automatic, 1, 400, false), 0) << "over what the frame holds";
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
    draw_in_tiles(stored, {.frame = view}, {2, 64, resolve(SimdTarget::best)}, {}, scratch, count);
    return scratch.list.tasks().size();
  };
  const int tiles_with_triangles = 1;
  EXPECT_EQ(tasks(side), tiles_with_triangles + 16u) << "and one for the empty tiles of each row";
  EXPECT_EQ(drawn, tiles_with_triangles);
  EXPECT_EQ(tasks(64), tiles_with_triangles + 8u) << "a single row's empty tiles, by 8 px of height";
}

// Tiles of which the part holds a pixel have tasks. If nothing is cleared, only those with triangles have.
TEST(TileTasks, AreThoseOfThePart) {
  constexpr int kSide = contract::kMaxTile, kLeg = 2000 * contract::kSub;
  const ScreenTriangle all_over{{0, kLeg, 0}, {0, 0, kLeg}, {9, 9, 9}, 5};
  Framebuffer frame(5 * kSide, 5 * kSide);
  const auto cells = [&](std::span<const ScreenTriangle> triangles, int x1, int y1, int x0, int y0,
                         bool clear) {
    FramePart part{.frame = frame.view(), .x0 = x0, .y0 = y0, .clear = clear};
    part.frame.width = x1, part.frame.height = y1;
    TileScratch scratch;
    StoredTriangles stored(triangles);
    draw_in_tiles(stored, part, {1, kSide, resolve(SimdTarget::best)}, {}, scratch, [](const TileTask&) {});
    std::vector<int> list;
    for (const TileList::Task& task : scratch.list.tasks()) list.push_back(task.cell);
    return list;
  };
  constexpr int kClear = TileList::kClearTiles;
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
  TileList list;
  for (const int size_log2 : {4, 5, 6})
    for (int height = 1; height <= 3 << size_log2; ++height)
      for (int threads = 1; threads <= 24; ++threads) {
        const CellGrid grid{100, height, size_log2, size_log2};
        bins.build(std::span<const ScreenTriangle>(), grid, 1, resolve(SimdTarget::best),
                   Bins::Small::as_indices);
        list.build(bins, grid, {}, threads, [](int) { return false; });
        const std::string where = std::to_string(1 << size_log2) + " px, height " + std::to_string(height) +
                                  ", threads " + std::to_string(threads);
        int y = 0;
        std::vector<std::vector<int>> heights(static_cast<std::size_t>(grid.rows()));
        for (const TileList::Task& task : list.tasks()) {
          ASSERT_EQ(task.cell, TileList::kClearTiles);
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
  static std::vector<std::atomic<int>> drawn(kColumns * kRows);
  static bool met = false;
  static const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  TileScratch scratch;
  StoredTriangles stored({&all_over, 1});
  draw_in_tiles(stored, {.frame = frame.view()}, {2, 64, resolve(SimdTarget::best)}, {}, scratch,
                [](const TileTask& task) {
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
      backends().front().make()->draw(triangles, expected.view(), {42});
      lab::poison(frame);
      TileScratch scratch;
      StoredTriangles stored(triangles);
      draw_in_tiles(stored, {.frame = frame.view(), .background = 42}, {2, 64, resolve(SimdTarget::best)},
                    {.tile_store = store}, scratch, tile_edges(resolve(SimdTarget::best)));
      testing::expect_same(expected, frame, std::to_string(width) + " px wide");
    }
}

// `count` triangles over the tile at (column, row), which differ in depth and cut each other.
void cover_tile(std::vector<ScreenTriangle>& triangles, int column, int row, int count, int size) {
  const int side = size * contract::kSub, x = column * side, y = row * side;
  for (int i = 0; i < count; ++i) {
    const auto id = static_cast<std::uint32_t>(triangles.size());
    triangles.push_back({{x + 300 + 90 * i, x + side - 40, x + 70},
                         {y + 200, y + side / 2 + 50 * i, y + side - 99},
                         {1000 * (id % 5), 1 << 20, 7000 * (id % 3)},
                         id + 1});
  }
}
int light_tiles(const TileList& list, int rows) {
  std::size_t count = 0;
  for (int row = 0; row < rows; ++row) count += list.light_tiles(row).size();
  return static_cast<int>(count);
}

// Light tiles beside empty and other ones, under a triangle across all tiles of two rows, in frames whose
// right and lower sides cut tiles.
TEST(LightTiles, AreDrawnLikeOthers) {
  for (const int size : {16, 32, 64})
    for (const auto& [width, height] : {std::pair{5 * size, 4 * size}, {5 * size - 3, 4 * size - 5}}) {
      std::vector<ScreenTriangle> triangles;
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column)
          cover_tile(triangles, column, row, (column + 2 * row) % 4, size);
      const int right = 5 * size * contract::kSub, side = size * contract::kSub;
      triangles.push_back({{0, right, 0}, {side, side, 3 * side}, {0, 5000, 1 << 21}, 99});
      Framebuffer expected(width, height), frame(width, height);
      backends().front().make()->draw(triangles, expected.view(), {42});
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 2, 8}) {
          lab::poison(frame);
          TileScratch scratch;
          StoredTriangles stored(triangles);
          draw_in_tiles(stored, {.frame = frame.view(), .background = 42}, {threads, size, target},
                        {.coverage_masks = false, .tile_store = TileStore::cached}, scratch,
                        tile_edges(target), frame_spans(target));
          testing::expect_same(expected, frame, testing::describe(Execution{threads, size, target}));
          EXPECT_GT(light_tiles(scratch.list, 4), 3);
          EXPECT_TRUE(
              std::ranges::any_of(scratch.list.tasks(), [](const auto& task) { return task.cell >= 0; }));
        }
    }
}

TEST(LightTiles, AreThoseOfFewTrianglesInCachedFrames) {
  constexpr int kSize = 64;
  std::vector<ScreenTriangle> triangles;
  for (int column = 0; column < 5; ++column) cover_tile(triangles, column, 0, column, kSize);
  Framebuffer frame(5 * kSize, kSize);
  const auto light = [&](const TileOptions& options, FrameKernel kernel, int width) {
    TileScratch scratch;
    StoredTriangles stored(triangles);
    FrameView view = frame.view();
    view.width = width;
    const SimdTarget target = resolve(SimdTarget::best);
    draw_in_tiles(stored, {.frame = view}, {1, kSize, target}, options, scratch, tile_edges(target), kernel);
    return light_tiles(scratch.list, 1);
  };
  const FrameKernel kernel = frame_spans(resolve(SimdTarget::best));
  EXPECT_EQ(light({.tile_store = TileStore::cached}, kernel, 5 * kSize), 2)
      << "one and two triangles, not three and four";
  EXPECT_EQ(light({.tile_store = TileStore::cached}, kernel, 3 * kSize - 1), 1) << "not a tile that is cut";
  EXPECT_EQ(light({.tile_store = TileStore::streaming}, kernel, 5 * kSize), 0);
  EXPECT_EQ(light({.tile_store = TileStore::cached}, nullptr, 5 * kSize), 0);
}

// The triangles of a tile count over all slices, and the first submitted one wins a tie.
TEST(LightTiles, CountTheTrianglesOfAllSlices) {
  constexpr int kSize = 64, kSide = kSize * contract::kSub;
  for (const int in_tile : {2, 3}) {
    std::vector<ScreenTriangle> triangles(2000, {{2 * kSide, 3 * kSide, 2 * kSide}, {0, 0, kSide}, {}, 7});
    for (int i = 0; i < in_tile; ++i)
      triangles[static_cast<std::size_t>(i == 0 ? 0 : 1000 + 400 * i)] = {
          {0, kSide, 0}, {0, 0, kSide}, {5, 5, 5}, static_cast<std::uint32_t>(i)};
    Framebuffer expected(3 * kSize, kSize), frame(3 * kSize, kSize);
    backends().front().make()->draw(triangles, expected.view(), {42});
    lab::poison(frame);
    TileScratch scratch;
    StoredTriangles stored(triangles);
    const SimdTarget target = resolve(SimdTarget::best);
    draw_in_tiles(stored, {.frame = frame.view(), .background = 42}, {2, kSize, target},
                  {.tile_store = TileStore::cached}, scratch, tile_edges(target), frame_spans(target));
    testing::expect_same(expected, frame, std::to_string(in_tile));
    EXPECT_EQ(light_tiles(scratch.list, 1), in_tile == 2 ? 1 : 0);
  }
}

}  // namespace
}  // namespace edgewise

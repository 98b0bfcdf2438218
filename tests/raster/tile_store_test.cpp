// Selection of the stores that copy a tile to the frame. Every backend test checks that cached and streaming
// stores write the same bits (kAblations).
#include <gtest/gtest.h>

#include <atomic>

#include "raster/tiles.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(TileStore, IsCachedOnlyForEmptyTilesOfFramesThatFitHalfTheCache) {
  constexpr std::size_t kLlc = 1 << 20;
  EXPECT_EQ(tile_store_for(true, kLlc / 2, kLlc), TileStore::cached);
  EXPECT_EQ(tile_store_for(true, kLlc / 2 + 1, kLlc), TileStore::streaming);
  EXPECT_EQ(tile_store_for(false, kLlc / 2, kLlc), TileStore::streaming);
}

TEST(TileStore, IsChosenPerTileUnlessTheCallerChooses) {
  const int side = 8 * contract::kMaxTile;
  const auto triangles = testing::adversarial("mixed-sizes", 400, side / 2 - 1, side, 5);
  Framebuffer frame(side, side);
  static std::atomic<int> streamed, empty;
  const TileKernel count = [](const TileTask& task) {
    streamed += task.ablation.tile_store == TileStore::streaming;
    empty += task.bins->empty(task.cell);
  };
  const auto tiles_streamed = [&](TileStore store) {
    streamed = empty = 0;
    Bins bins;
    draw_in_tiles(triangles, frame.view(), 0, {2, 64, resolve(SimdTarget::best)}, {.tile_store = store}, 64,
                  bins, Bins::Small::as_indices, count);
    return streamed.load();
  };
  EXPECT_EQ(tiles_streamed(TileStore::streaming), 64);
  EXPECT_EQ(tiles_streamed(TileStore::cached), 0);
  const int automatic = tiles_streamed(TileStore::automatic);
  EXPECT_GT(empty, 0);
  EXPECT_LT(empty, 64);
  EXPECT_EQ(automatic, 64 - empty);
}

}  // namespace
}  // namespace edgewise

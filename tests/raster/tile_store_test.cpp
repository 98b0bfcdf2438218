// Which stores copy a tile to the frame, and the size of the cache that decides on it. Every backend test
// checks that this choice changes no picture.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <string>

#include "raster/kernels.h"
#include "raster/llc.h"
#include "raster/traversals.h"
#include "support.h"
#include "temp_dir.h"

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

TEST(LargestCache, IsTheLargestThatTheFolderNames) {
  const struct {
    std::map<int, std::string> sizes;  // the files `size`, by the number of the cache
    std::size_t kib;                   // 0: none is known
  } cases[] = {{{{0, "48K\n"}, {1, "32K\n"}, {2, "1024K\n"}, {3, "32768K\n"}}, 32768},
               {{{0, "32K\n"}, {3, "491520K\n"}, {2, "512K\n"}}, 491520},  // one of unknown size
               {{{0, "64K\n"}, {9, "512K"}}, 512},
               {{}, 0},
               {{{0, ""}, {1, "K\n"}, {2, "512\n"}, {3, "512M\n"}, {4, "99999999999K\n"}}, 0}};
  for (const auto& [sizes, kib] : cases) {
    const TempDir folder;
    for (const auto& [index, size] : sizes) {
      const std::string cache = "index" + std::to_string(index);
      std::filesystem::create_directory(folder.path() / cache);
      folder.write(cache + "/size", size);
    }
    EXPECT_EQ(largest_cache_bytes(folder.path().string()), kib << 10);
  }
}

}  // namespace
}  // namespace edgewise

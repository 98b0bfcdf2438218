// How tiles go to the frame: by size, and, where a frame ought to stay in the last cache, by what takes less
// time.
#include "raster/write_out_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "raster/last_cache.h"
#include "support.h"

namespace edgewise::testing {
namespace {

constexpr std::size_t kCache = 32'000'000, kFits = 16'000'000, kTiles = 510;

// What a frame's tiles were told. Those that are timed get the times of their way; tiles for which `empty`
// holds are empty.
template <typename Empty>
std::vector<WriteOut> frame(WriteOutChoice& choice, std::int64_t through_ns, std::int64_t past_ns,
                            Empty&& empty, std::size_t frame_bytes = kFits, std::size_t triangle_bytes = 0) {
  std::vector<WriteOut> ways;
  choice.begin_frame(frame_bytes, triangle_bytes, 1);
  for (std::size_t i = 0; i < kTiles; ++i) {
    const auto told = choice.for_tile(static_cast<int>(i), empty(i));
    if (told.elapsed_ns != nullptr)
      *told.elapsed_ns = told.way == WriteOut::past_caches ? past_ns : through_ns;
    ways.push_back(told.way);
  }
  choice.end_frame();
  return ways;
}
std::vector<WriteOut> frame(WriteOutChoice& choice, std::int64_t through_ns, std::int64_t past_ns,
                            std::size_t frame_bytes = kFits, std::size_t triangle_bytes = 0) {
  return frame(
      choice, through_ns, past_ns, [](std::size_t) { return false; }, frame_bytes, triangle_bytes);
}

std::ptrdiff_t past(const std::vector<WriteOut>& ways) {
  return std::count(ways.begin(), ways.end(), WriteOut::past_caches);
}
// Two of each 64.
constexpr std::ptrdiff_t kOtherWay = 16, kUsualWay = kTiles - kOtherWay;

TEST(WriteOutChoice, GoesPastTheCachesWithWhatDoesNotFitHalfOfTheLast) {
  WriteOutChoice choice(kCache);
  EXPECT_EQ(past(frame(choice, 1, 9, kFits + 4)), static_cast<std::ptrdiff_t>(kTiles));
  EXPECT_EQ(past(frame(choice, 1, 9, kFits - 40, 44)), static_cast<std::ptrdiff_t>(kTiles));
  EXPECT_EQ(past(frame(choice, 1, 9, kFits - 40, 40)), kOtherWay);
}

TEST(WriteOutChoice, CountsNoTrianglesWhereATileIsEmpty) {
  WriteOutChoice choice(kCache);
  const auto ways = frame(
      choice, 1, 9, [](std::size_t i) { return i % 2 == 0; }, kFits - 40, 44);
  EXPECT_EQ(ways[0], WriteOut::through_caches);
  EXPECT_EQ(ways[1], WriteOut::past_caches);
}

TEST(WriteOutChoice, DoesNotTrySmallFramesTheOtherWay) {
  WriteOutChoice choice(kCache);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(past(frame(choice, 9, 1, kFits / 4)), 0);
  choice.begin_frame(kFits / 4, 0, 1);
  for (int i = 0; i < static_cast<int>(kTiles); ++i)
    EXPECT_EQ(choice.for_tile(i, false).elapsed_ns, nullptr) << i;
}

TEST(WriteOutChoice, TurnsWhereThreeFramesInARowTookLessTheOtherWay) {
  WriteOutChoice choice(kCache);
  EXPECT_EQ(past(frame(choice, 100, 80)), kOtherWay);
  EXPECT_EQ(past(frame(choice, 100, 120)), kOtherWay);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(past(frame(choice, 100, 80)), kOtherWay) << i;
  EXPECT_EQ(past(frame(choice, 100, 80)), kUsualWay);
  EXPECT_EQ(past(frame(choice, 100, 80, kFits / 4)), 0) << "a small frame";
  for (int i = 0; i < 3; ++i) EXPECT_EQ(past(frame(choice, 80, 100)), kUsualWay) << i;
  EXPECT_EQ(past(frame(choice, 80, 100)), kOtherWay);
}

TEST(WriteOutChoice, StaysWhereLittleIsGained) {
  WriteOutChoice choice(kCache);
  for (int i = 0; i < 9; ++i) EXPECT_NE(past(frame(choice, 100, 91)), kUsualWay) << i;
}

TEST(WriteOutChoice, LooksSixFramesOf32) {
  WriteOutChoice choice(kCache);
  for (int i = 0; i < 70; ++i) EXPECT_EQ(past(frame(choice, 100, 120)), i % 32 < 6 ? kOtherWay : 0) << i;
}

// An empty tile is filled, another one is copied.
TEST(WriteOutChoice, ComparesTilesOfOneKind) {
  WriteOutChoice choice(kCache);
  for (int i = 0; i < 9; ++i)
    EXPECT_LE(past(frame(choice, 100, 50, [](std::size_t tile) { return tile % 64 < 32; })), kOtherWay) << i;
}

TEST(WriteOutChoice, IsNotMisledByATileThatTookLong) {
  WriteOutChoice choice(kCache);
  for (int i = 0; i < 9; ++i) {
    choice.begin_frame(kFits, 0, 1);
    for (std::size_t tile = 0; tile < kTiles; ++tile) {
      const auto told = choice.for_tile(static_cast<int>(tile), false);
      if (told.elapsed_ns != nullptr) *told.elapsed_ns = tile < 3 * 64 && tile % 64 > 32 ? 100'000 : 100;
    }
    choice.end_frame();
  }
  EXPECT_EQ(past(frame(choice, 100, 100)), 0);
}

TEST(WriteOutChoice, LooksAtTheFirstTilesOfALargeFrame) {
  WriteOutChoice choice(std::size_t{1} << 40);
  choice.begin_frame(std::size_t{1} << 38, 0, 1);
  int timed = 0;
  for (int tile = 0; tile < 65'536; ++tile) timed += choice.for_tile(tile, false).elapsed_ns != nullptr;
  EXPECT_EQ(timed, 2 * 64);
}

// A frame that just fits half of the last cache, so that some tiles go the other way.
TEST(WriteOutChoice, LeavesTheBitsAsTheyAre) {
  constexpr int kWidth = 1024;
  const std::size_t row_bytes = 8 * kWidth;
  const int height = static_cast<int>(std::clamp<std::size_t>(last_cache_bytes() / 2 / row_bytes, 1, 4096));
  const auto triangles = adversarial("mixed-sizes", 400, kWidth, height, 5);
  Framebuffer expected(kWidth, height), drawn(kWidth, height);
  find_backend("naive").make()->draw(triangles, expected.view(), kBackground, {});
  for (const auto& info : filling_backends()) {
    const auto backend = info.make();
    for (int i = 0; i < 5; ++i) {
      backend->draw(triangles, drawn.view(), kBackground, {2});
      expect_same(expected, drawn, std::string(info.name) + ", frame " + std::to_string(i));
    }
  }
}

}  // namespace
}  // namespace edgewise::testing

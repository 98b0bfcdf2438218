// How tiles go to the frame: by size, and, where a frame ought to stay in the last cache, by what takes less
// time.
#include "raster/write_out_choice.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "lab/measure.h"
#include "raster/scanline/scanline_kernel.h"
#include "raster/tiled/tile_kernel.h"
#include "raster/tiles.h"
#include "support.h"

namespace edgewise::testing {
namespace {

constexpr std::size_t kCache = 32'000'000, kFits = 16'000'000;
constexpr int kTiles = 510;

struct Times {
  std::int64_t through_ns, past_ns;
};
constexpr Times kThroughIsFaster{80, 100}, kPastIsFaster{100, 80};

class WriteOutChoices : public ::testing::Test {
 protected:
  // How many tiles of a frame were told to go past the caches. Those that are timed get the times of their
  // way; tiles for which `empty` holds are empty.
  template <typename Empty>
  int past(const Times& times, const WriteOutChoice::Frame& frame, Empty&& empty) {
    int count = 0;
    choice_.begin_frame(frame);
    for (int tile = 0; tile < frame.tiles; ++tile) {
      const auto told = choice_.for_tile(tile, empty(tile));
      const bool is_past = told.way == WriteOut::past_caches;
      if (told.elapsed_ns != nullptr) *told.elapsed_ns = is_past ? times.past_ns : times.through_ns;
      count += is_past;
    }
    choice_.end_frame();
    return count;
  }
  int past(const Times& times, const WriteOutChoice::Frame& frame = {kFits, 0, kTiles, 2}) {
    return past(times, frame, [](int) { return false; });
  }
  // Of a frame after a look.
  int past_after_looking(const Times& times, const WriteOutChoice::Frame& frame = {kFits, 0, kTiles, 2}) {
    for (int i = 0; i < kLook; ++i) past(times, frame);
    return past(times, frame);
  }
  static constexpr int kLook = 6, kTried = 16;  // frames, and tiles of one
  WriteOutChoice choice_{kCache};
};

TEST_F(WriteOutChoices, ArePastTheCachesForWhatDoesNotFitHalfOfTheLast) {
  EXPECT_EQ(past_after_looking(kThroughIsFaster, {kFits + 4, 0, kTiles, 2}), kTiles);
  EXPECT_EQ(past_after_looking(kThroughIsFaster, {kFits - 40, 44, kTiles, 2}), kTiles);
  EXPECT_EQ(past_after_looking(kThroughIsFaster, {kFits - 40, 40, kTiles, 2}), 0);
}

TEST_F(WriteOutChoices, CountNoTrianglesWhereATileIsEmpty) {
  const auto even = [](int tile) { return tile % 2 == 0; };
  const WriteOutChoice::Frame frame{kFits - 40, 44, kTiles, 2};
  for (int i = 0; i < kLook; ++i) past(kThroughIsFaster, frame, even);
  EXPECT_EQ(past(kThroughIsFaster, frame, even), kTiles / 2);
}

TEST_F(WriteOutChoices, AreThroughTheCachesForSmallFrames) {
  for (const WriteOutChoice::Frame& frame :
       {WriteOutChoice::Frame{kFits / 4, 0, kTiles, 2}, {kFits, 0, 149, 2}})
    for (int i = 0; i < 9; ++i) EXPECT_EQ(past(kPastIsFaster, frame), 0) << i;
}

TEST_F(WriteOutChoices, FollowTheTimesOfALook) {
  for (int i = 0; i < kLook; ++i) EXPECT_EQ(past(kPastIsFaster), kTried) << i;
  for (int i = kLook; i < 128; ++i) EXPECT_EQ(past(kThroughIsFaster), kTiles) << i;
  for (int i = 0; i < kLook; ++i) EXPECT_EQ(past(kThroughIsFaster), kTried) << i;
  for (int i = kLook; i < 32; ++i) EXPECT_EQ(past(kPastIsFaster), 0) << i;
  EXPECT_EQ(past_after_looking(kPastIsFaster), kTiles);
}

// 1280 x 720 has 20 x 12 tiles of 64 px. What is shown is in the middle.
TEST_F(WriteOutChoices, LearnFromFramesOf240Tiles) {
  const WriteOutChoice::Frame frame{kFits / 2, 0, 240, 2};
  const auto empty = [](int tile) { return std::abs(tile % 20 - 10) > 5 || std::abs(tile / 20 - 6) > 3; };
  for (int i = 0; i < kLook; ++i) past(kPastIsFaster, frame, empty);
  EXPECT_EQ(past(kPastIsFaster, frame, empty), 240);
}

TEST_F(WriteOutChoices, LetTheCachesSettle) {
  for (int i = 0; i < kLook; ++i) past(i < 4 ? kPastIsFaster : kThroughIsFaster);
  EXPECT_EQ(past(kThroughIsFaster), 0);
}

TEST_F(WriteOutChoices, NeedThreeOfFourFrames) {
  for (int i = 0; i < kLook; ++i) past(i < 4 ? kThroughIsFaster : kPastIsFaster);
  EXPECT_EQ(past(kPastIsFaster), 0);
  for (int i = kLook + 1; i < 32; ++i) past(kPastIsFaster);
  for (int i = 0; i < kLook; ++i) past(i < 3 ? kThroughIsFaster : kPastIsFaster);
  EXPECT_EQ(past(kPastIsFaster), kTiles);
  for (int i = kLook + 1; i < 128; ++i) past(kPastIsFaster);
  for (int i = 0; i < kLook; ++i) past(i < 4 ? kThroughIsFaster : kPastIsFaster);
  EXPECT_EQ(past(kPastIsFaster), 0) << "earlier looks count no more";
}

TEST_F(WriteOutChoices, StayWhereLittleIsGained) {
  EXPECT_EQ(past_after_looking({100, 91}), 0);
}

TEST_F(WriteOutChoices, AreRememberedForEachKindOfFrame) {
  const std::vector<WriteOutChoice::Frame> slow_past{{kFits - 50, 40, kTiles, 2}};
  const std::vector<WriteOutChoice::Frame> fast_past{{kFits - 66, 40, kTiles, 2},
                                                     {kFits - 50, 20, kTiles, 2},
                                                     {kFits - 50, 60, kTiles, 2},
                                                     {kFits - 50, 40, kTiles - 1, 2},
                                                     {kFits - 50, 40, kTiles, 1}};
  for (int i = 0; i < kLook; ++i) {
    for (const auto& frame : slow_past) past(kThroughIsFaster, frame, [](int) { return true; });
    for (const auto& frame : fast_past) past(kPastIsFaster, frame, [](int) { return true; });
  }
  for (const auto& frame : slow_past) EXPECT_EQ(past(kPastIsFaster, frame, [](int) { return true; }), 0);
  for (const auto& frame : fast_past)
    EXPECT_EQ(past(kThroughIsFaster, frame, [](int) { return true; }), frame.tiles);
}

TEST_F(WriteOutChoices, ForgetWhatWasNotDrawnForLongest) {
  EXPECT_EQ(past_after_looking(kPastIsFaster), kTiles);
  const auto others = [&](std::size_t begin, std::size_t end) {
    for (std::size_t kind = begin; kind < end; ++kind) past(kThroughIsFaster, {kFits - kind, 0, kTiles, 2});
  };
  others(1, 64);
  EXPECT_EQ(past(kThroughIsFaster), kTiles);
  others(64, 65);
  EXPECT_EQ(past(kThroughIsFaster), kTiles) << "another one is forgotten";
  others(65, 129);
  EXPECT_EQ(past(kThroughIsFaster), kTried) << "is looked at anew";
}

// An empty tile is filled, another one is copied.
TEST_F(WriteOutChoices, CompareTilesOfOneKind) {
  const WriteOutChoice::Frame frame{kFits, 0, kTiles, 2};
  const auto unlike = [](int tile) { return tile % 64 < 20; };
  for (int i = 0; i < kLook; ++i) past(kPastIsFaster, frame, unlike);
  EXPECT_EQ(past(kPastIsFaster, frame, unlike), 0);
}

TEST_F(WriteOutChoices, StayAsTheyAreWhereFewerThanThreePairsAreAlike) {
  const WriteOutChoice::Frame frame{kFits, 0, kTiles, 2};
  const auto two_alike = [](int tile) { return tile % 64 < 20 && tile >= 2 * 64; };
  for (int i = 0; i < kLook; ++i) past(kPastIsFaster, frame, two_alike);
  EXPECT_EQ(past(kPastIsFaster), 0);
  for (int i = kLook + 1; i < 32; ++i) past(kPastIsFaster);
  EXPECT_EQ(past_after_looking(kPastIsFaster), kTiles);
  for (int i = kLook + 1; i < 128; ++i) past(kPastIsFaster);
  for (int i = 0; i < kLook; ++i) past(kThroughIsFaster, frame, two_alike);
  EXPECT_EQ(past(kThroughIsFaster), kTiles);
}

TEST_F(WriteOutChoices, AreNotMisledByATileThatTookLong) {
  for (int i = 0; i < kLook; ++i) {
    choice_.begin_frame({kFits, 0, kTiles, 2});
    for (int tile = 0; tile < kTiles; ++tile) {
      const auto told = choice_.for_tile(tile, false);
      if (told.elapsed_ns != nullptr) *told.elapsed_ns = tile < 3 * 64 && tile % 64 > 20 ? 100'000 : 100;
    }
    choice_.end_frame();
  }
  EXPECT_EQ(past({100, 100}), 0);
}

TEST_F(WriteOutChoices, TryTheFirstTilesOfALargeFrame) {
  choice_ = WriteOutChoice(std::size_t{1} << 40);
  EXPECT_EQ(past(kThroughIsFaster, {std::size_t{1} << 38, 0, 65'536, 2}), 2 * 64);
}

// Whoever draws tiles tells how long it took, and writes the same bits either way.
TEST(WriteOut, IsTimedAndLeavesTheBitsAsTheyAre) {
  constexpr int kWidth = 1280, kHeight = 720;
  const auto triangles =
      adversarial("mixed-sizes", 400, kWidth / 2, kHeight, 5);  // the right half stays empty
  Framebuffer expected(kWidth, kHeight), drawn(kWidth, kHeight);
  find_backend("naive").make()->draw(triangles, expected.view(), kBackground, {});
  for (const SimdTarget target : supported_targets())
    for (const auto& [name, kernel] :
         {std::pair{"tiled", tile_kernel(target)}, {"scanline", scanline_kernel(target)}})
      for (const WriteOut way : {WriteOut::through_caches, WriteOut::past_caches}) {
        lab::poison(drawn);
        Bins bins;
        const CellGrid grid{kWidth, kHeight, 6, 6};
        bins.build(triangles, grid, 1, target, Bins::Small::as_indices, true);
        int empty = 0, timed = 0;
        for (int cell = 0; cell < grid.cells(); ++cell) {
          std::int64_t ns = -1;
          TileTask job{triangles.data(),
                       &bins,
                       cell,
                       cell % grid.columns() * 64,
                       cell / grid.columns() * 64,
                       6,
                       drawn.view(),
                       kBackground,
                       {},
                       &ns};
          job.ideas.write_out = way;
          kernel(job);
          empty += bins.empty(cell), timed += ns >= 0;
        }
        const std::string what = std::string(name) + " on " + std::string(name_of(target));
        EXPECT_EQ(timed, grid.cells()) << what;
        EXPECT_GT(empty, 0);
        expect_same(expected, drawn, what);
      }
}

// Through a whole look and beyond, with some tiles past the caches.
TEST(WriteOut, OfFramesInDoubtLeavesTheBitsAsTheyAre) {
  constexpr int kWidth = 1280, kHeight = 720;
  const auto triangles = adversarial("mixed-sizes", 400, kWidth, kHeight, 6);
  Framebuffer expected(kWidth, kHeight), drawn(kWidth, kHeight);
  find_backend("naive").make()->draw(triangles, expected.view(), kBackground, {});
  TileScratch scratch{{}, WriteOutChoice(4 * 8 * kWidth * kHeight)};
  for (int frame = 0; frame < 8; ++frame) {
    lab::poison(drawn);
    draw_in_tiles(triangles, drawn.view(), kBackground, {2, 64, resolve(SimdTarget::best)}, 64, scratch,
                  Bins::Small::as_masks, tile_kernel(resolve(SimdTarget::best)));
    expect_same(expected, drawn, "frame " + std::to_string(frame));
  }
}

// What draw_in_tiles() does with the choice, with a kernel that draws nothing and takes less time past the
// caches.
TEST(WriteOut, IsChosenForEachFrame) {
  constexpr int kWidth = 1280, kHeight = 720;
  static std::atomic<int> past;
  const TileKernel count_past = [](const TileTask& job) {
    const bool is_past = job.ideas.write_out == WriteOut::past_caches;
    past += is_past;
    if (job.write_out_ns != nullptr) *job.write_out_ns = is_past ? 80 : 100;
  };
  Framebuffer frame(kWidth, kHeight);
  TileScratch scratch{{}, WriteOutChoice(4 * 8 * kWidth * kHeight)};
  const auto told_past = [&](SimdTarget target, WriteOut way) {
    past = 0;
    Execution execution{2, 64, target};
    execution.ideas.write_out = way;
    draw_in_tiles({}, frame.view(), kBackground, execution, 64, scratch, Bins::Small::as_indices, count_past);
    return past.load();
  };
  const SimdTarget best = resolve(SimdTarget::best);
  EXPECT_EQ(told_past(best, WriteOut::past_caches), 240);
  EXPECT_EQ(told_past(best, WriteOut::through_caches), 0);
  EXPECT_EQ(told_past(SimdTarget::scalar, WriteOut::automatic), 0);
  if (best == SimdTarget::scalar) return;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(told_past(best, WriteOut::automatic), 8) << i;
  EXPECT_EQ(told_past(best, WriteOut::automatic), 240);
}

}  // namespace
}  // namespace edgewise::testing

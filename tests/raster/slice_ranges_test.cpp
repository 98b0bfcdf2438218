// Slices that workers split: each input is in one slice, and in_order() is the order of the inputs.
#include "raster/binning/slice_ranges.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"

namespace edgewise {
namespace {

using Taken = std::vector<std::vector<std::pair<std::size_t, std::size_t>>>;  // by slice

void expect_all_in_order(SliceRanges& ranges, const Taken& taken, std::size_t count) {
  std::size_t at = 0;
  for (const std::size_t slice : ranges.in_order())
    for (const auto& [begin, end] : taken[slice]) {
      EXPECT_EQ(begin, at);
      at = end;
    }
  EXPECT_EQ(at, count);
}

TEST(SliceRanges, HoldEachInputOnceWhateverIsSplitWhen) {
  SliceRanges ranges;
  for (const auto& [count, at_once, first, most] : {std::array<std::size_t, 4>{0, 64, 1, 4},
                                                    {1, 64, 1, 1},
                                                    {999, 64, 2, 8},
                                                    {100'000, 256, 3, 12},
                                                    {77, 1, 4, 5}})
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
      Random random(seed);
      Taken taken(most);
      ranges.start(count, {first, most, at_once, 0});
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < first; ++i) open.push_back(i);
      while (!open.empty()) {
        const std::size_t i = random.below(open.size());
        if (const auto inputs = ranges.next(open[i])) {
          EXPECT_LE(inputs->end - inputs->begin, at_once);
          taken[open[i]].push_back({inputs->begin, inputs->end});
        } else if (const auto slice = ranges.split()) {
          open[i] = *slice;
        } else {
          open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
        }
      }
      expect_all_in_order(ranges, taken, count);
    }
}

TEST(SliceRanges, GiveAnIdleWorkerHalfOfTheLongestRestUnlessItIsShort) {
  SliceRanges ranges;
  for (const std::size_t least_rest : {401u, 400u}) {
    ranges.start(1000, {2, 3, 10, least_rest});
    while (ranges.next(1)) continue;
    for (int i = 0; i < 10; ++i) ranges.next(0);  // 40 pieces are left
    EXPECT_EQ(ranges.split(), least_rest == 400 ? std::optional<std::size_t>(2) : std::nullopt);
  }
  EXPECT_EQ(ranges.next(2)->begin, 300u);
  EXPECT_EQ(ranges.split(), std::nullopt) << "there are three slices";
  const auto order = ranges.in_order();
  EXPECT_EQ(std::vector(order.begin(), order.end()), (std::vector<std::size_t>{0, 2, 1}));
}

TEST(SliceRanges, HoldEachInputOnceOnSeveralThreads) {
  SliceRanges ranges;
  constexpr std::size_t kCount = 50'000, kThreads = 4, kMost = 16;
  for (int round = 0; round < 20; ++round) {
    Taken taken(kMost);
    ranges.start(kCount, {kThreads, kMost, 64, 0});
    parallel_for(kThreads, kThreads, [&](int worker) {
      for (std::optional slice{static_cast<std::size_t>(worker)}; slice; slice = ranges.split())
        while (const auto inputs = ranges.next(*slice)) taken[*slice].push_back({inputs->begin, inputs->end});
    });
    expect_all_in_order(ranges, taken, kCount);
  }
}

}  // namespace
}  // namespace edgewise

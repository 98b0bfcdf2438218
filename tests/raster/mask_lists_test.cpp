// Lists of coverage masks return the appended masks in order, for every read size and after memory growth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/binning/mask_finder.h"
#include "raster/binning/mask_lists.h"

namespace edgewise {
namespace {

using Half = SortedTriangles::Half;

// A mask whose fields depend on its number.
void append(MaskLists& lists, std::uint32_t cell, std::uint32_t number) {
  lists.append(cell, number + 5, Half{{number, ~number, 1, 2}}, Half{{number + 1, 3, 4, cell}});
}

// The numbers in a list that is read at most `most` masks at a time.
std::vector<std::uint32_t> numbers(const MaskLists& lists, std::size_t cell, std::size_t most) {
  std::vector<std::uint32_t> out;
  MaskLists::Reader reader(lists, cell);
  for (auto ahead = reader.ahead(); !ahead.empty(); ahead = reader.ahead()) {
    const std::size_t count = std::min(most, ahead.size());
    for (const CoverageMask& mask : ahead.first(count)) {
      EXPECT_EQ(mask.rows[1], ~mask.rows[0]);
      EXPECT_EQ(mask.z, mask.rows[0] + 1);
      EXPECT_EQ(mask.rank, mask.rows[0] + 5);
      out.push_back(mask.rows[0]);
    }
    reader.pass(count);
  }
  return out;
}

struct Size {
  std::size_t cells, expected, appended;
};
class MaskListsOfSize : public testing::TestWithParam<Size> {};

TEST_P(MaskListsOfSize, KeepOrderWhenMemoryGrows) {
  const auto [cells, expected, appended] = GetParam();
  MaskLists lists;
  for (std::uint32_t frame = 0; frame < 2; ++frame) {  // the second frame reuses the memory of the first
    lists.reset(cells, expected);
    EXPECT_FALSE(lists.any());
    std::vector<std::vector<std::uint32_t>> in_list(cells);
    for (std::uint32_t i = 0; i < appended; ++i) {
      const std::size_t cell = (i * 2654435761u >> 16) % (cells + 1) % cells;  // cell 0 gets more masks
      append(lists, static_cast<std::uint32_t>(cell), i + frame);
      in_list[cell].push_back(i + frame);
    }
    EXPECT_TRUE(lists.any());
    for (std::size_t c = 0; c < cells; ++c) {
      EXPECT_EQ(lists.empty(c), in_list[c].empty());
      for (const std::size_t most : {std::size_t{1}, std::size_t{3}, appended})
        EXPECT_EQ(numbers(lists, c, most), in_list[c]);
    }
  }
}

// Segments of 256 bytes hold 7 masks, segments of 4096 bytes 127. Each slab is twice as large as the one
// before, so the fifth begins after 15 times the expected number.
INSTANTIATE_TEST_SUITE_P(Sizes, MaskListsOfSize,
                         testing::Values(Size{1, 1, 1}, Size{3, 1, 7}, Size{3, 1, 5000}, Size{510, 1, 3000},
                                         Size{1, 4000, 20000}, Size{2, 4000, 90000}));

}  // namespace
}  // namespace edgewise

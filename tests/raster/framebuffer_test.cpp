// The row layout of the library's own frames, and the limits of their sides.
#include "edgewise/framebuffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "edgewise/contract.h"

namespace edgewise {
namespace {

using namespace contract;

TEST(Framebuffer, RowsAreCacheLinesAndAvoidPageStrides) {
  constexpr int kLinePx = 16, kPagePx = 1024;
  for (const int width : {1, 16, 17, 1008, 1009, 1024, 1025, 1920, 2048, 4096, kMaxImageSide}) {
    Framebuffer frame(width, 3);
    EXPECT_GE(frame.stride(), width);
    EXPECT_LT(frame.stride(), width + 2 * kLinePx) << width;
    EXPECT_EQ(frame.stride() % kLinePx, 0) << width;
    EXPECT_NE(frame.stride() % kPagePx, 0) << width;
    for (const std::uint32_t* row : {frame.depth_row(1), frame.payload_row(2)})
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(row) % (kLinePx * sizeof(*row)), 0u) << width;
  }
}

TEST(Framebuffer, LargeFramesBeginAtAHugePage) {
  constexpr int kSmall = 64, kLarge = 1100;  // px; 4.9 MB per plane
  constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
  const auto begins_at_huge_page = [](const std::uint32_t* plane) {
    return reinterpret_cast<std::uintptr_t>(plane) % kHugePage == 0;
  };
  for (const auto& [from, to] : {std::pair{kSmall, kLarge}, {kLarge, kSmall}}) {
    Framebuffer moved(from, from), frame(to, to);
    for (const std::uint32_t* plane : {moved.depth_row(0), moved.payload_row(0)})
      EXPECT_EQ(begins_at_huge_page(plane), from == kLarge);
    const FrameView view = moved.view();
    view.depth[view.stride * (from - 1)] = 7;
    frame = std::move(moved);  // frees the old memory, which has another alignment
    EXPECT_EQ(frame.depth_row(from - 1), view.depth + view.stride * (from - 1));
    EXPECT_EQ(*frame.depth_row(from - 1), 7u);
  }
}

TEST(Framebuffer, RefusesSidesOutsideTheContract) {
  for (const int side : {-1, 0, kMaxImageSide + 1, 1'000'000}) {
    EXPECT_THROW(Framebuffer(side, 4), std::invalid_argument);
    EXPECT_THROW(Framebuffer(4, side), std::invalid_argument);
  }
}

}  // namespace
}  // namespace edgewise

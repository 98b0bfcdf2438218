// Hierarchical depth: of each block of a tile, a depth that none of its pixels is behind. What lies behind
// that as a whole is hidden (Greene, Kass and Miller, "Hierarchical Z-buffer visibility", 1993).
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "edgewise/contract.h"
#include "raster/simd/lanes-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_HIZ_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_HIZ_INL_H
#undef EDGEWISE_HIZ_INL_H
#else
#define EDGEWISE_HIZ_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of the kColumns x kRows blocks of the largest tile, row by row; kLanes divides their number.
template <int kColumns, int kRows>
class HiZ {
 public:
  // The tile's first width x height px lie in the frame; blocks beside them show nothing.
  void clear(int width, int height) {
    const auto blocks = [](int px, int most) {
      return (px * most + contract::kMaxTile - 1) / contract::kMaxTile;
    };
    const int columns = blocks(width, kColumns), rows = blocks(height, kRows);
    std::fill(std::begin(depth_), std::end(depth_), static_cast<std::int32_t>(contract::kDepthClear));
    for (int row = 0; row < rows; ++row) std::fill(at(columns, row), at(0, row + 1), 0);
    std::fill(at(0, rows), at(0, kRows), 0);
    last_ = 0;
  }
  // Of a block and those behind it, as many as a row has.
  HWY_INLINE std::int32_t* at(int column, int row) { return depth_ + row * kColumns + column; }

  // Whether what is nowhere nearer than `nearest` is hidden in all blocks.
  HWY_INLINE bool occludes(std::int32_t nearest) { return nearest >= depth_[last_] && !find_behind(nearest); }

 private:
  static constexpr int kBlocks = kColumns * kRows;
  static_assert(kBlocks % kLanes == 0);
  static constexpr std::size_t kRoom = kBlocks + kColumns;

  // Whether a block's farthest depth lies behind `nearest`. Remembers which is the last of all.
  HWY_NOINLINE bool find_behind(std::int32_t nearest) {
    const D d;
    V most = hn::Load(d, depth_), begin = hn::Zero(d);
    for (int i = kLanes; i < kBlocks; i += kLanes) {
      const V here = hn::Load(d, depth_ + i);
      begin = hn::IfThenElse(hn::Lt(most, here), hn::Set(d, i), begin);
      most = hn::Max(most, here);
    }
    const V most_of_all = hn::MaxOfLanes(d, most);
    if (nearest >= hn::GetLane(most_of_all)) return false;
    const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Eq(most, most_of_all)));
    alignas(64) std::int32_t begins[kLanes];
    hn::Store(begin, d, begins);
    last_ = begins[lane] + static_cast<int>(lane);
    return true;
  }

  alignas(64) std::int32_t depth_[kRoom];
  int last_;  // the block whose farthest depth was the last of all: most questions end there
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

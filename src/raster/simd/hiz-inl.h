// HiZ (hierarchical depth): stores zmax for each block of a tile, a depth that no pixel of the block exceeds.
// A triangle whose nearest depth in a block is not below zmax is occluded there (Greene, Kass and Miller,
// "Hierarchical Z-buffer visibility", 1993).
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"

// Included once per SIMD target.
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

// For the kColumns x kRows blocks of the largest tile, row by row. kLanes must divide the number of blocks.
template <int kColumns, int kRows>
class HiZ {
 public:
  // `width`, `height`: the part of the tile in the frame, px. Blocks outside it get zmax 0, so they occlude
  // all.
  void clear(int width, int height) {
    const auto blocks = [](int px, int of_tile) {
      return (px * of_tile + contract::kMaxTile - 1) / contract::kMaxTile;
    };
    const int columns = blocks(width, kColumns), rows = blocks(height, kRows);
    std::fill(std::begin(zmax_), std::end(zmax_), static_cast<std::int32_t>(contract::kDepthClear));
    for (int row = 0; row < rows; ++row) std::fill(at(columns, row), at(0, row + 1), 0);
    std::fill(at(0, rows), at(0, kRows), 0);
    greatest_block_ = 0;
  }
  // zmax of a block. At least a whole row of entries may be read and written from there.
  HWY_INLINE std::int32_t* at(int column, int row) { return zmax_ + row * kColumns + column; }

  // Whether a triangle with no depth below `nearest` is occluded in all blocks.
  HWY_INLINE bool occludes(std::int32_t nearest) {
    return nearest >= zmax_[greatest_block_] && !any_zmax_behind(nearest);
  }

 private:
  static constexpr int kBlocks = kColumns * kRows;
  static_assert(kBlocks % kLanes == 0);
  static constexpr std::size_t kCapacity = kBlocks + kColumns;

  // Whether the zmax of a block exceeds `nearest`. If so, stores the block with the largest zmax.
  bool any_zmax_behind(std::int32_t nearest) {
    const D d;
    V greatest = hn::Load(d, zmax_), begin = hn::Zero(d);
    for (int i = kLanes; i < kBlocks; i += kLanes) {
      const V here = hn::Load(d, zmax_ + i);
      begin = hn::IfThenElse(hn::Lt(greatest, here), hn::Set(d, i), begin);
      greatest = hn::Max(greatest, here);
    }
    const V max_zmax = hn::MaxOfLanes(d, greatest);
    if (nearest >= hn::GetLane(max_zmax)) return false;
    const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Eq(greatest, max_zmax)));
    alignas(64) std::int32_t begins[kLanes];
    hn::Store(begin, d, begins);
    greatest_block_ = begins[lane] + static_cast<int>(lane);
    return true;
  }

  alignas(64) std::int32_t zmax_[kCapacity];
  int greatest_block_;  // had the largest zmax at the last search: decides most calls of occludes()
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

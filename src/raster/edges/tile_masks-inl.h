// Draws coverage masks: the covered pixels are known, only the depth test is left.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstdint>
#include <span>

#include "raster/binning/mask_lists.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/fill_counts.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_MASKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_MASKS_INL_H
#undef EDGEWISE_TILE_MASKS_INL_H
#else
#define EDGEWISE_TILE_MASKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The bit of each pixel of a block in CoverageMask::covered, for a mask's left and right blocks.
alignas(64) constexpr auto kMaskBits = [] {
  struct {
    std::int32_t left[kBlockPixels], right[kBlockPixels];
  } bits{};
  for (int i = 0; i < kBlockPixels; ++i) {
    bits.left[i] = static_cast<std::int32_t>(1u << (i / kBlockSide * kMaskSide + i % kBlockSide));
    bits.right[i] =
        static_cast<std::int32_t>(1u << (i / kBlockSide * kMaskSide + i % kBlockSide + kBlockSide));
  }
  return bits;
}();

constexpr std::ptrdiff_t kMasksAhead = 32;  // prefetch distance

// Draws masks up to the first with a rank above `last`, and returns their number. Writes all four blocks of
// every mask: a branch that skips blocks without a covered pixel would be mispredicted too often.
HWY_NOINLINE inline std::size_t draw_masks(Tile& tile, std::span<const CoverageMask> masks,
                                           std::uint32_t last) {
  const D d;
  static_assert(kMaskSide == 2 * kBlockSide);
  std::size_t n = 0;
  for (; n != masks.size() && masks[n].rank <= last; ++n) {
    const CoverageMask& mask = masks[n];
    hwy::Prefetch(&mask + kMasksAhead);
    const V zx = hn::Set(d, wrap(mask.zx)), zy = hn::Set(d, wrap(mask.zy));
    const V z0 = hn::Set(d, wrap(mask.z)), payload = hn::Set(d, wrap(mask.payload));
    const V right = hn::ShiftLeft<2>(zx), down = hn::ShiftLeft<2>(zy);
    const V rows[2] = {hn::Set(d, wrap(mask.covered[0])), hn::Set(d, wrap(mask.covered[1]))};
    for (int p = 0; p < kBlockPixels; p += kLanes) {
      const V left_bits = hn::Load(d, kMaskBits.left + p), right_bits = hn::Load(d, kMaskBits.right + p);
      V z = hn::Add(z0, hn::Add(hn::Mul(hn::Load(d, kLaneX + p), zx), hn::Mul(hn::Load(d, kLaneY + p), zy)));
      int at = static_cast<int>(mask.block) * kBlockPixels + p;
      for (int y = 0; y < 2; ++y) {
        write_whole(tile, at, hn::TestBit(rows[y], left_bits), z, payload);
        write_whole(tile, at + kBlockPixels, hn::TestBit(rows[y], right_bits), hn::Add(z, right), payload);
        z = hn::Add(z, down);
        at += kMaxBlocks * kBlockPixels;
      }
    }
  }
  count(Part::masks, n);
  return n;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// Drawing patches: which pixels they cover is known, what is left is the test of depth.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstdint>
#include <span>

#include "raster/binning/coverage_mask.h"
#include "raster/tiled/tile_blocks-inl.h"

// Included once a SIMD target.
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

// The bit of each of a block's pixels in CoverageMask::rows, in its left and in its right blocks.
alignas(64) constexpr auto kPatchBits = [] {
  struct {
    std::int32_t left[kBlockPixels], right[kBlockPixels];
  } bits{};
  for (int i = 0; i < kBlockPixels; ++i) {
    bits.left[i] = static_cast<std::int32_t>(1u << (i / kBlock * kMaskSide + i % kBlock));
    bits.right[i] = static_cast<std::int32_t>(1u << (i / kBlock * kMaskSide + i % kBlock + kBlock));
  }
  return bits;
}();

constexpr std::ptrdiff_t kPatchesAhead = 32;  // are asked for

// Draws patches up to the first of a rank above `last`; returns how many. All four blocks of a patch are
// written, for no branch could guess which of them are touched.
HWY_NOINLINE std::size_t draw_masks(Tile& tile, std::span<const CoverageMask> patches, std::uint32_t last) {
  const D d;
  static_assert(kMaskSide == 2 * kBlock);
  std::size_t n = 0;
  for (; n != patches.size() && patches[n].rank <= last; ++n) {
    const CoverageMask& patch = patches[n];
    hwy::Prefetch(&patch + kPatchesAhead);
    const V zx = hn::Set(d, wrap(patch.zx)), zy = hn::Set(d, wrap(patch.zy));
    const V z0 = hn::Set(d, wrap(patch.z)), payload = hn::Set(d, wrap(patch.payload));
    const V right = hn::ShiftLeft<2>(zx), down = hn::ShiftLeft<2>(zy);
    const V rows[2] = {hn::Set(d, wrap(patch.rows[0])), hn::Set(d, wrap(patch.rows[1]))};
    for (int p = 0; p < kBlockPixels; p += kLanes) {
      const V left_bits = hn::Load(d, kPatchBits.left + p), right_bits = hn::Load(d, kPatchBits.right + p);
      V z = hn::Add(z0, hn::Add(hn::Mul(hn::Load(d, kLaneX + p), zx), hn::Mul(hn::Load(d, kLaneY + p), zy)));
      int at = static_cast<int>(patch.block) * kBlockPixels + p;
      for (int y = 0; y < 2; ++y) {
        write_whole(tile, at, hn::TestBit(rows[y], left_bits), z, payload);
        write_whole(tile, at + kBlockPixels, hn::TestBit(rows[y], right_bits), hn::Add(z, right), payload);
        z = hn::Add(z, down);
        at += kMaxBlocks * kBlockPixels;
      }
    }
  }
  return n;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

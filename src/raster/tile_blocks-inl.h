// The tile's buffer, and what its two ways of drawing share: blocks of 4 x 4 pixels, 16 consecutive integers
// (one AVX-512 vector, two of AVX2, four of SSE4), and lists of those that a triangle touches.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "raster/contract.h"
#include "raster/tile_kernel.h"
#include "raster/tile_setup-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_TILE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_BLOCKS_INL_H
#undef EDGEWISE_TILE_BLOCKS_INL_H
#else
#define EDGEWISE_TILE_BLOCKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));
constexpr int kBlockPixels = 16;
constexpr int kVectors = kBlockPixels / kLanes;  // in a block
constexpr int kMaxBlocks = kMaxTile / kBlock;    // a side of a tile
constexpr int kBlocksAtOnce = 16;  // are sifted together, which as many lanes as they have pixels
static_assert(kBlocksAtOnce == kMaxBlocks && kBlocksAtOnce == kBlockPixels);

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

struct Tile {
  alignas(64) std::int32_t depth[kMaxTile * kMaxTile];  // block by block, 16 pixels each
  alignas(64) std::int32_t payload[kMaxTile * kMaxTile];
  // No pixel of the block is farther.
  alignas(64) std::int32_t farthest[kMaxBlocks * kMaxBlocks + kBlocksAtOnce];
};

HWY_INLINE std::uint32_t mask_bits(hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D{}, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
// For each mask, the lanes that it selects, and then any. Highway 1.0.3 has the same table in Compress(), but
// GCC copies it to the stack at every call.
constexpr auto kSelected = [] {
  struct {
    std::uint8_t lane[1 << kLanes][kLanes];
  } table{};
  for (int mask = 0; mask < 1 << kLanes; ++mask) {
    int count = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      if (mask >> lane & 1) table.lane[mask][count++] = static_cast<std::uint8_t>(lane);
  }
  return table;
}();
HWY_INLINE V selected_first(V v, hn::Mask<D> mask) {
  const D d;
  const hn::Rebind<std::uint8_t, D> d8;
  const auto lanes = hn::PromoteTo(d, hn::LoadU(d8, kSelected.lane[mask_bits(mask)]));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes));
}
#else
HWY_INLINE V selected_first(V v, hn::Mask<D> mask) {
  return hn::Compress(v, mask);
}
#endif

// A list that a vector's selected lanes are appended to; it needs kLanes to spare.
struct List {
  std::int32_t* at;
  int length = 0;
  HWY_INLINE void append(V v, hn::Mask<D> mask) {
    hn::StoreU(selected_first(v, mask), D{}, at + length);
    length += static_cast<int>(hn::CountTrue(D{}, mask));
  }
};

// Values of a linear function over sixteen pixels, or the same over sixteen blocks.
struct Sixteen {
  V v[kVectors];
};
// Over one block, relative to its first pixel.
HWY_INLINE Sixteen over_block(const std::int32_t* x, const std::int32_t* y) {
  const D d;
  Sixteen out;
  for (int i = 0; i < kVectors; ++i)
    out.v[i] = hn::Add(hn::Mul(hn::Load(d, kLaneX + i * kLanes), hn::Set(d, *x)),
                       hn::Mul(hn::Load(d, kLaneY + i * kLanes), hn::Set(d, *y)));
  return out;
}

// Tests and writes a vector of a block's pixels.
HWY_INLINE void write(Tile& tile, int at, V outside, V z, V payload) {
  const D d;
  const V old_z = hn::Load(d, tile.depth + at);
  const auto wins = hn::AndNot(hn::Lt(outside, hn::Zero(d)), hn::Lt(z, old_z));
  hn::Store(hn::IfThenElse(wins, z, old_z), d, tile.depth + at);
  hn::Store(hn::IfThenElse(wins, payload, hn::Load(d, tile.payload + at)), d, tile.payload + at);
}

#if HWY_TARGET != HWY_SCALAR
// A vector of a pixel row, from the blocks that it crosses.
HWY_INLINE V across_blocks(const std::int32_t* from) {
  const D d;
  const hn::Full128<std::int32_t> quarter;
  const auto part = [&](int block) { return hn::Load(quarter, from + block * kBlockPixels); };
#if HWY_TARGET == HWY_SSE4
  return part(0);
#elif HWY_TARGET == HWY_AVX2
  return hn::Combine(d, part(1), part(0));
#else
  const hn::Half<D> half;
  return hn::Combine(d, hn::Combine(half, part(3), part(2)), hn::Combine(half, part(1), part(0)));
#endif
}
#endif

// Blocks back to rows, past the caches where that is wanted and the frame's alignment allows it.
inline void write_out(const TileJob& job, const std::int32_t* blocks, std::uint32_t* plane) {
  const int width = std::min(1 << job.size_log2, job.frame.width - job.x0);
  const int height = std::min(1 << job.size_log2, job.frame.height - job.y0);
#if HWY_TARGET != HWY_SCALAR
  const D d;
  const bool streams = job.ideas.write_out == WriteOut::past_caches &&
                       reinterpret_cast<std::uintptr_t>(plane) % sizeof(V) == 0 &&
                       job.frame.stride % kLanes == 0;
#endif
  for (int y = 0; y < height; ++y) {
    const std::int32_t* from = blocks + y / kBlock * kMaxBlocks * kBlockPixels + y % kBlock * kBlock;
    auto* to = reinterpret_cast<std::int32_t*>(plane + (job.y0 + y) * job.frame.stride + job.x0);
    int x = 0;
#if HWY_TARGET != HWY_SCALAR
    const auto each_vector = [&](const auto& store) {
      for (; x + kLanes <= width; x += kLanes, from += kLanes / kBlock * kBlockPixels)
        store(across_blocks(from), to + x);
    };
    if (streams)
      each_vector([&](V v, std::int32_t* at) { hn::Stream(v, d, at); });
    else
      each_vector([&](V v, std::int32_t* at) { hn::StoreU(v, d, at); });
#endif
    for (; x < width; x += kBlock, from += kBlockPixels)
      std::memcpy(to + x, from, sizeof(std::int32_t) * static_cast<std::size_t>(std::min(kBlock, width - x)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// The tile's buffer, and what its ways of drawing share: blocks of 4 x 4 pixels, 16 consecutive integers
// (one AVX-512 vector, two of AVX2, four of SSE4), and lists of those that a triangle touches.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "edgewise/contract.h"
#include "raster/simd/hiz-inl.h"
#include "raster/simd/tile_store-inl.h"
#include "raster/tile_task.h"
#include "raster/tiled/tile_setup-inl.h"

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

constexpr int kBlockPixels = 16;
constexpr int kVectors = kBlockPixels / kLanes;  // in a block
constexpr int kMaxBlocks = kMaxTile / kBlock;    // a side of a tile
constexpr int kBlocksAtOnce = 16;  // are sifted together, which as many lanes as they have pixels
static_assert(kBlocksAtOnce == kMaxBlocks && kBlocksAtOnce == kBlockPixels);

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

constexpr int kTilePixels = kMaxBlocks * kMaxBlocks * kBlockPixels;

class Tile {
 public:
  // Block by block, 16 pixels each. A patch at the end of a plane takes along blocks behind it, in which it
  // has no pixel: they may be read and written back, whatever they hold, and are the payload's first ones, or
  // spare.
  HWY_INLINE std::int32_t* depth() { return planes_; }
  HWY_INLINE std::int32_t* payload() { return planes_ + kTilePixels; }  // see Payloads

 private:
  static constexpr int kSpare = (kMaxBlocks + 1) * kBlockPixels;
  alignas(64) std::int32_t planes_[2 * kTilePixels + kSpare];

 public:
  HiZ<kMaxBlocks, kMaxBlocks> hiz;
};

// A list that a vector's selected lanes are appended to; it needs kLanes to spare.
struct List {
  std::int32_t* at;
  int length = 0;
  HWY_INLINE void append(V v, hn::Mask<D> mask) {
    hn::StoreU(Selection(mask)(v), D{}, at + length);
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

// Stores the lanes of a mask. Where masks have registers of their own (AVX-512), a store under one is faster.
HWY_INLINE void replace(std::int32_t* at, hn::Mask<D> where, V v) {
#if HWY_TARGET <= HWY_AVX3  // the better the target, the lower its number
  hn::BlendedStore(v, where, D{}, at);
#else
  hn::Store(hn::IfThenElse(where, v, hn::Load(D{}, at)), D{}, at);
#endif
}
HWY_INLINE hn::Mask<D> inside(V outside) {
  return hn::Gt(outside, hn::Set(D{}, -1));
}
// Tests and writes those of a vector of a block's pixels that are covered.
HWY_INLINE void write(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const auto wins = hn::And(covered, hn::Lt(z, hn::Load(D{}, tile.depth() + at)));
  replace(tile.depth() + at, wins, z);
  replace(tile.payload() + at, wins, payload);
}
// The same, but depths are stored whole: in a mesh, the next small triangle often wants the same block, and a
// load has to wait until what was stored under a mask has reached the cache.
HWY_INLINE void write_whole(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const V old_z = hn::Load(D{}, tile.depth() + at);
  const auto wins = hn::And(covered, hn::Lt(z, old_z));
  hn::Store(hn::IfThenElse(wins, z, old_z), D{}, tile.depth() + at);
  replace(tile.payload() + at, wins, payload);
}

#if HWY_TARGET != HWY_SCALAR
constexpr int kBlocksAcross = kLanes / kBlock;  // as many as fill a vector of a pixel row

// Two neighbouring pixel rows of neighbouring blocks; `from` is where the first block's part of them begins.
template <typename Pixels>
HWY_INLINE void two_rows_of_blocks(const Pixels& pixels, int from, V& upper, V& lower) {
  const D d;
#if HWY_TARGET == HWY_SSE4
  upper = pixels(d, from);
  lower = pixels(d, from + kBlock);
#elif HWY_TARGET == HWY_AVX2
  const V left = pixels(d, from), right = pixels(d, from + kBlockPixels);
  upper = hn::ConcatLowerLower(d, right, left);
  lower = hn::ConcatUpperUpper(d, right, left);
#else
  const hn::Half<D> half;
  const auto of_blocks = [&](int first, int second) {
    return hn::Combine(d, pixels(half, from + second * kBlockPixels),
                       pixels(half, from + first * kBlockPixels));
  };
  const V even = of_blocks(0, 2), odd = of_blocks(1, 3);
  upper = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd), even);
  lower = hn::OddEvenBlocks(odd, hn::SwapAdjacentBlocks(even));
#endif
}
#endif

// How much of a tile goes to the frame in whole vectors, two rows at a time. What is left is copied as it is:
// who draws it has cleared its payloads.
struct InVectors {
  int width = 0, height = 0;  // px
  bool all;
  InVectors(int tile_width, int tile_height) {
    if (kLanes > 1) width = tile_width & -kLanes, height = tile_height & -2;
    all = width == tile_width && height == tile_height;
  }
};

// Blocks back to rows. Rows are written whole, one after the other: processors bring neighbouring cache lines
// together, and those of several rows at once often want the same places in the caches.
template <typename Pixels>
void write_blocks(const Place& to, const Pixels& pixels) {
  const auto part_of_row = [](int x, int y) {
    return y / kBlock * kMaxBlocks * kBlockPixels + y % kBlock * kBlock + x * kBlock;
  };
  const InVectors in_vectors(to.width, to.height);
#if HWY_TARGET != HWY_SCALAR
  constexpr int kWhole = kMaxTile / kLanes;
  write_to(to, [&](const auto& store) {
    const auto write_two_rows = [&](int y, int count) {
      std::int32_t *const upper_row = to.row(y), *const lower_row = to.row(y + 1);
      V lower[kWhole];
      for (int i = 0; i < count; ++i) {
        V upper;
        two_rows_of_blocks(pixels, part_of_row(i * kLanes, y), upper, lower[i]);
        store(upper, upper_row + i * kLanes);
      }
      for (int i = 0; i < count; ++i) store(lower[i], lower_row + i * kLanes);
    };
    for (int y = 0; y < in_vectors.height; y += 2)
      to.width == kMaxTile ? write_two_rows(y, kWhole) : write_two_rows(y, to.width / kLanes);
  });
#endif
  for (int y = 0; y < to.height; ++y)
    for (int x = y < in_vectors.height ? in_vectors.width : 0; x < to.width; x += kBlock)
      std::memcpy(to.row(y) + x, pixels.buffer + part_of_row(x, y),
                  sizeof(std::int32_t) * static_cast<std::size_t>(std::min(kBlock, to.width - x)));
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

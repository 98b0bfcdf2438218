// The tile's buffer, and what its ways of drawing share: blocks of 4 x 4 pixels, 16 consecutive integers
// (one AVX-512 vector, two of AVX2, four of SSE4), and lists of those that a triangle touches.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "raster/contract.h"
#include "raster/tile_kernel.h"
#include "raster/tile_place-inl.h"
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
  // has no pixel: they may be read and written back, and are the payload's first ones, or spare.
  HWY_INLINE std::int32_t* depth() { return planes_; }
  HWY_INLINE std::int32_t* payload() { return planes_ + kTilePixels; }

 private:
  static constexpr int kSpare = (kMaxBlocks + 1) * kBlockPixels;
  alignas(64) std::int32_t planes_[2 * kTilePixels + kSpare];

 public:
  // No pixel of the block is farther. Sifting reads and writes back what lies right of a box.
  static constexpr int kFarthest = kMaxBlocks * kMaxBlocks + kBlocksAtOnce;
  alignas(64) std::int32_t farthest[kFarthest];
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

// Writes those of a vector of a block's pixels that win, given their old depths. Stores under a mask are
// faster where a mask has a register of its own.
HWY_INLINE void write(Tile& tile, int at, hn::Mask<D> wins, [[maybe_unused]] V old_z, V z, V payload) {
  const D d;
  std::int32_t* const to_depth = tile.depth() + at;
  std::int32_t* const to_payload = tile.payload() + at;
#if HWY_TARGET <= HWY_AVX3  // the better the target, the lower its number
  hn::BlendedStore(z, wins, d, to_depth);
  hn::BlendedStore(payload, wins, d, to_payload);
#else
  hn::Store(hn::IfThenElse(wins, z, old_z), d, to_depth);
  hn::Store(hn::IfThenElse(wins, payload, hn::Load(d, to_payload)), d, to_payload);
#endif
}
// Tests and writes them where `outside` is not negative.
HWY_INLINE void write(Tile& tile, int at, V outside, V z, V payload) {
  const D d;
  const V old_z = hn::Load(d, tile.depth() + at);
  write(tile, at, hn::And(hn::Gt(outside, hn::Set(d, -1)), hn::Lt(z, old_z)), old_z, z, payload);
}

#if HWY_TARGET != HWY_SCALAR
constexpr int kBlocksAcross = kLanes / kBlock;  // as many as fill a vector of a pixel row

// The four pixel rows of neighbouring blocks.
HWY_INLINE void rows_of_blocks(const std::int32_t* from, V (&row)[kBlock]) {
  const D d;
#if HWY_TARGET == HWY_SSE4
  for (int y = 0; y < kBlock; ++y) row[y] = hn::Load(d, from + y * kBlock);
#elif HWY_TARGET == HWY_AVX2
  for (int y = 0; y < kBlock; y += 2) {
    const V left = hn::Load(d, from + y * kBlock), right = hn::Load(d, from + kBlockPixels + y * kBlock);
    row[y] = hn::ConcatLowerLower(d, right, left);
    row[y + 1] = hn::ConcatUpperUpper(d, right, left);
  }
#else
  V block[4];
  for (int i = 0; i < 4; ++i) block[i] = hn::Load(d, from + i * kBlockPixels);
  const auto two_rows = [&](V even, V odd, V* out) {  // two rows each of blocks 0 and 2, and of 1 and 3
    out[0] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd), even);
    out[1] = hn::OddEvenBlocks(odd, hn::SwapAdjacentBlocks(even));
  };
  two_rows(hn::ConcatLowerLower(d, block[2], block[0]), hn::ConcatLowerLower(d, block[3], block[1]), row);
  two_rows(hn::ConcatUpperUpper(d, block[2], block[0]), hn::ConcatUpperUpper(d, block[3], block[1]), row + 2);
#endif
}
#endif

// Blocks back to rows.
inline void write_out(const Place& to, const std::int32_t* blocks) {
  for (int y0 = 0; y0 < to.height; y0 += kBlock, blocks += kMaxBlocks * kBlockPixels) {
    const int rows = std::min(kBlock, to.height - y0);
    const std::int32_t* from = blocks;
    int x = 0;
#if HWY_TARGET != HWY_SCALAR
    for (; x + kLanes <= to.width; x += kLanes, from += kBlocksAcross * kBlockPixels) {
      V row[kBlock];
      rows_of_blocks(from, row);
      for (int y = 0; y < rows; ++y) to.store(row[y], x, y0 + y);
    }
#endif
    for (; x < to.width; x += kBlock, from += kBlockPixels)
      for (int y = 0; y < rows; ++y)
        std::memcpy(to.at + (y0 + y) * to.stride + x, from + y * kBlock,
                    sizeof(std::int32_t) * static_cast<std::size_t>(std::min(kBlock, to.width - x)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

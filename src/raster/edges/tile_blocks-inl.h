// The tile's buffer, and code shared by the ways of drawing into it. The buffer stores blocks of 4 x 4
// pixels, each as 16 consecutive integers: one AVX-512 vector, two of AVX2, four of SSE4 or
// NEON.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "edgewise/contract.h"
#include "raster/edges/tile_setup-inl.h"
#include "raster/kernels.h"
#include "raster/simd/hiz-inl.h"
#include "raster/tile_store-inl.h"

// Included once per SIMD target.
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
constexpr int kVectors = kBlockPixels / kLanes;    // per block
constexpr int kMaxBlocks = kMaxTile / kBlockSide;  // per side of a tile
constexpr int kBlocksAtOnce = 16;                  // tested together, one lane per block
static_assert(kBlocksAtOnce == kMaxBlocks && kBlocksAtOnce == kBlockPixels);

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

constexpr int kTilePixels = kMaxBlocks * kMaxBlocks * kBlockPixels;

class Tile {
 public:
  // Block by block, 16 pixels each. A coverage mask at the end of a plane also reads and writes back blocks
  // behind the plane, unchanged, because it covers no pixel there. These are the first payload blocks, or
  // kSpare.
  HWY_INLINE std::int32_t* depth() { return planes_; }
  // Cleared only if the tile is not stored in whole vectors: else Payloads inserts the background.
  HWY_INLINE std::int32_t* payload() { return planes_ + kTilePixels; }

 private:
  static constexpr int kSpare = (kMaxBlocks + 1) * kBlockPixels;
  alignas(64) std::int32_t planes_[2 * kTilePixels + kSpare];

 public:
  HiZ<kMaxBlocks, kMaxBlocks> hiz;
};

// A list to which the selected lanes of a vector are appended. The memory needs kLanes spare entries.
struct List {
  std::int32_t* at;
  int length = 0;
  HWY_INLINE void append(V v, hn::Mask<D> mask) {
    hn::StoreU(Selection(mask)(v), D{}, at + length);
    length += static_cast<int>(hn::CountTrue(D{}, mask));
  }
};

// The values of a linear function at the 16 pixels of a block.
template <class Lanes>
struct Values16 {
  typename Lanes::Vector v[kVectors];
};
// Relative to the value at the block's first pixel. `x`, `y`: steps per pixel.
template <class Lanes>
HWY_INLINE Values16<Lanes> over_block(const typename Lanes::Value* x, const typename Lanes::Value* y) {
  const D d;
  Values16<Lanes> out;
  for (int i = 0; i < kVectors; ++i)
    out.v[i] = Lanes::add(Lanes::times(hn::Load(d, kLaneX + i * kLanes), *x),
                          Lanes::times(hn::Load(d, kLaneY + i * kLanes), *y));
  return out;
}

// Stores the lanes of a mask. With AVX-512, which has mask registers, a masked store is faster.
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
// Depth-tests a vector of a block's pixels and writes those that are covered and nearer.
HWY_INLINE void write(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const auto wins = hn::And(covered, hn::Lt(z, hn::Load(D{}, tile.depth() + at)));
  replace(tile.depth() + at, wins, z);
  replace(tile.payload() + at, wins, payload);
}
// The same, but stores whole depth vectors. In a mesh, the next small triangle often loads the same block,
// and a load cannot be forwarded from a masked store: it waits until the store has reached the cache.
HWY_INLINE void write_whole(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const V old_z = hn::Load(D{}, tile.depth() + at);
  const auto wins = hn::And(covered, hn::Lt(z, old_z));
  hn::Store(hn::IfThenElse(wins, z, old_z), D{}, tile.depth() + at);
  replace(tile.payload() + at, wins, payload);
}

#if HWY_TARGET != HWY_SCALAR
constexpr int kBlocksAcross = kLanes / kBlockSide;  // blocks whose pixel rows fill one vector

// Two neighbouring pixel rows of kBlocksAcross neighbouring blocks. `from`: index of the first row's first
// pixel.
template <typename Pixels>
HWY_INLINE void two_rows_of_blocks(const Pixels& pixels, int from, V& upper, V& lower) {
  const D d;
#if HWY_MAX_BYTES == 16
  upper = pixels(d, from);
  lower = pixels(d, from + kBlockSide);
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

// The part of a tile that is stored to the frame in whole vectors, two rows at a time: nothing if columns at
// the left or rows at the top are not drawn. The rest is copied without a test for background, so the tile's
// payload must be cleared where `all` is false.
struct InVectors {
  int width = 0, height = 0;  // px
  bool all;
  explicit InVectors(const TileTask& task)
      : InVectors(task.left(), task.top(), task.width(), task.height()) {}
  InVectors(int left, int top, int tile_width, int tile_height) {
    if (kLanes > 1 && left == 0 && top == 0) width = tile_width & -kLanes, height = tile_height & -2;
    all = width == tile_width && height == tile_height;
  }
};

// The index of a pixel in a plane of the tile's buffer.
HWY_INLINE int at_pixel(int x, int y) {
  return y / kBlockSide * kMaxBlocks * kBlockPixels + x / kBlockSide * kBlockPixels +
         y % kBlockSide * kBlockSide + x % kBlockSide;
}

// Calls copy(pixels, in_buffer, count) for the pixels of a row from column x on, block by block: the first of
// `count` in the frame, and its index in the buffer.
template <typename Copy>
HWY_INLINE void for_each_block_of_row(const FramePlane& plane, int x, int y, Copy&& copy) {
  for (int end; x < plane.width; x = end) {
    end = std::min((x | (kBlockSide - 1)) + 1, plane.width);
    copy(plane.row(y) + x, at_pixel(x, y), end - x);
  }
}
// Copies up to kBlockSide pixels.
HWY_INLINE void copy_pixels(std::int32_t* to, const std::int32_t* from, int count) {
  if (count == kBlockSide)
    std::memcpy(to, from, kBlockSide * sizeof *to);  // a constant size needs no call
  else
    std::memcpy(to, from, static_cast<std::size_t>(count) * sizeof *to);
}

// Loads blocks from rows.
inline void read_blocks(const FramePlane& from, std::int32_t* buffer) {
  for (int y = from.top; y < from.height; ++y)
    for_each_block_of_row(from, from.left, y, [&](const std::int32_t* pixels, int in_buffer, int count) {
      copy_pixels(buffer + in_buffer, pixels, count);
    });
}

// Stores blocks as rows. Each row is written to its end before the next: processors fetch neighbouring cache
// lines together, and lines of several rows often compete for the same cache sets.
template <typename Pixels>
void write_blocks(const FramePlane& to, const Pixels& pixels) {
  const InVectors in_vectors(to.left, to.top, to.width, to.height);
#if HWY_TARGET != HWY_SCALAR
  constexpr int kWhole = kMaxTile / kLanes;
  write_to(to, [&](const auto& store) {
    const auto write_two_rows = [&](int y, int count) {
      std::int32_t *const upper_row = to.row(y), *const lower_row = to.row(y + 1);
      V lower[kWhole];
      for (int i = 0; i < count; ++i) {
        V upper;
        two_rows_of_blocks(pixels, at_pixel(i * kLanes, y), upper, lower[i]);
        store(upper, upper_row + i * kLanes);
      }
      for (int i = 0; i < count; ++i) store(lower[i], lower_row + i * kLanes);
    };
    for (int y = 0; y < in_vectors.height; y += 2)
      to.width == kMaxTile ? write_two_rows(y, kWhole) : write_two_rows(y, to.width / kLanes);
  });
#endif
  if (in_vectors.all) return;
  for (int y = to.top; y < to.height; ++y)
    for_each_block_of_row(to, y < in_vectors.height ? in_vectors.width : to.left, y,
                          [&](std::int32_t* row, int in_buffer, int count) {
                            copy_pixels(row, pixels.buffer + in_buffer, count);
                          });
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

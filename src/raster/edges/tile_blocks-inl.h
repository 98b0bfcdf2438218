// The tile's buffer, and the drawing of triangles of at most 4 x 4 blocks.
//
// The buffer stores blocks of 4 x 4 pixels, each as 16 consecutive integers: one AVX-512 vector, two of AVX2,
// four of SSE4 or NEON.
#include <hwy/highway.h>

#include <cstdint>

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

constexpr int kVectors = kBlockPixels / kLanes;  // per block
static_assert(kMaxBlocks == kBlockPixels);       // a row of blocks fills as many vectors as a block

alignas(64) constexpr std::int32_t kLaneX[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

class Tile {
 public:
  // Block by block. A coverage mask at a side also reads blocks beyond it, where it has no bits, and writes
  // them back: the first of the next row, or behind the plane the first payload blocks, or kSpare.
  HWY_INLINE std::int32_t* depth() { return planes_; }
  HWY_INLINE std::int32_t* payload() { return planes_ + kPixels; }

 private:
  static constexpr int kPixels = kMaxBlocks * kMaxBlocks * kBlockPixels;
  static constexpr int kSpare = (kMaxBlocks + 1) * kBlockPixels;
  alignas(64) std::int32_t planes_[2 * kPixels + kSpare];

 public:
  HiZ<kMaxBlocks, kMaxBlocks> hiz;
};

// Sets zmax to the farthest depth that a block holds. Returns whether any block's zmax is below kDepthClear.
inline bool load_hiz(const TileTask& task, Tile& tile) {
  const D d;
  const int columns = (task.width() + kBlockSide - 1) / kBlockSide,
            rows = (task.height() + kBlockSide - 1) / kBlockSide;
  V lowest = hn::Set(d, wrap(kDepthClear));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::int32_t* const block = tile.depth() + (row * kMaxBlocks + column) * kBlockPixels;
      V zmax = hn::Load(d, block);
      for (int p = 1; p < kVectors; ++p) zmax = hn::Max(zmax, hn::Load(d, block + p * kLanes));
      zmax = hn::MaxOfLanes(d, zmax);
      lowest = hn::Min(lowest, zmax);
      *tile.hiz.at(column, row) = hn::GetLane(zmax);
    }
  return hn::GetLane(lowest) < wrap(kDepthClear);
}

HWY_INLINE hn::Mask<D> not_negative(V v) {
  return hn::Gt(v, hn::Set(D{}, -1));
}

// Depth-tests a vector of a block's pixels and writes those that are covered and nearer.
HWY_INLINE void depth_test(Tile& tile, int at, hn::Mask<D> covered, V z, V payload) {
  const auto wins = hn::And(covered, hn::Lt(z, hn::Load(D{}, tile.depth() + at)));
  replace(tile.depth() + at, wins, z);
  replace(tile.payload() + at, wins, payload);
}

// The values of triangle k's linear function at the 16 pixels of a block, relative to the block's first
// pixel.
template <class Numbers>
struct Values16 {
  typename Numbers::Vector v[kVectors];
  HWY_INLINE Values16(const Linear<typename Numbers::Value>& f, int k) {
    for (int p = 0; p < kVectors; ++p)
      v[p] = Numbers::add(Numbers::times(hn::Load(D{}, kLaneX + p * kLanes), f.x[k]),
                          Numbers::times(hn::Load(D{}, kLaneY + p * kLanes), f.y[k]));
  }
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

// Triangles whose boxes lie in a square of 4 x 4 blocks. All blocks of a triangle are tested at once, one
// lane per block. The candidate blocks of many triangles go into one list: the number per triangle is hard to
// predict for a branch predictor, but a loop over a list is not.
template <class Numbers>
class BlockSquares {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit BlockSquares(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch<Numbers>& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++, in_slots = slot * kBlockPixels;
    const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]),
            last_row = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const Values16<Numbers> edge_in[3] = {{batch.edge[0], k}, {batch.edge[1], k}, {batch.edge[2], k}};
    const Values16<Int32Numbers> depth_in(batch.depth, k);
    const int first_block = batch.by0[k] * kMaxBlocks + batch.bx0[k];
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      // The blocks of the square are arranged like the pixels of a block, at four times the distance.
      const auto store_values = [&](auto numbers, auto offset, auto first, auto& values) {
        const auto at = numbers.add(numbers.set(first), numbers.four_times(offset));
        numbers.store_values(offset, values.in_block + in_slots + lane);
        numbers.store_values(at, values.at_block + in_slots + lane);
        return at;
      };
      const auto largest_in_block = [&](int i) {
        const auto at = store_values(Numbers{}, edge_in[i].v[p], batch.edge[i].first[k], edge_[i]);
        return Numbers::add(at, Numbers::set(batch.edge[i].rise[k]));
      };
      store_values(Int32Numbers{}, depth_in.v[p], batch.depth.first[k], depth_);
      const V column = hn::Load(d, kLaneX + lane), row = hn::Load(d, kLaneY + lane);
      const auto beside = hn::Or(hn::Gt(column, last_column), hn::Gt(row, last_row));
      const auto candidate =
          not_negative(Numbers::any_negative(largest_in_block(0), largest_in_block(1), largest_in_block(2)));
      const V block = hn::Add(hn::Mul(row, hn::Set(d, kMaxBlocks)), column);
      const V entry = hn::Add(hn::ShiftLeft<16>(block), counting_from(lane));
      list_.append(hn::Add(entry, hn::Set(d, first_block << 16 | in_slots)), hn::AndNot(beside, candidate));
    }
    payload_[slot] = batch.payload[k];
  }

  HWY_INLINE void draw() {
    for (int n = 0; n < list_.length; ++n) {
      const int block = list_.at[n] >> 16, in_slots = list_.at[n] & 0xFFFF, slot = in_slots / kBlockPixels;
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](auto numbers, const auto& values) {
          return numbers.add(numbers.set(values.at_block[in_slots]),
                             numbers.load_values(values.in_block + slot * kBlockPixels + p * kLanes));
        };
        const auto edge = [&](int i) { return value(Numbers{}, edge_[i]); };
        depth_test(tile_, block * kBlockPixels + p * kLanes,
                   not_negative(Numbers::any_negative(edge(0), edge(1), edge(2))),
                   value(Int32Numbers{}, depth_), hn::Set(D{}, payload_[slot]));
      }
    }
    used_ = list_.length = 0;
  }

 private:
  static constexpr int kSlots = 16;
  template <typename Value>
  struct alignas(64) SlotValues {
    Value at_block[kSlots * kBlockPixels], in_block[kSlots * kBlockPixels];
  };
  Tile& tile_;
  int used_ = 0;
  SlotValues<typename Numbers::Value> edge_[3];
  SlotValues<std::int32_t> depth_;
  std::int32_t payload_[kSlots];
  // the block in the tile << 16 | slot * 16 + the block's index in the square
  std::int32_t candidates_[(kSlots + 1) * kBlockPixels];
  List list_{candidates_};
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

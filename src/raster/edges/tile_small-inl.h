// Draws small triangles: tests all blocks of a triangle at once, and draws the blocks of many triangles in
// one loop.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_setup-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_SMALL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_SMALL_INL_H
#undef EDGEWISE_TILE_SMALL_INL_H
#else
#define EDGEWISE_TILE_SMALL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// For each block of a 4 x 4 square of blocks: its offset in the tile << 16 | its index in the square.
alignas(64) constexpr auto kSquareEntries = [] {
  struct {
    std::int32_t v[kBlocksAtOnce];
    constexpr const std::int32_t* operator+(int i) const { return v + i; }
  } entries{};
  for (int i = 0; i < kBlocksAtOnce; ++i) entries.v[i] = (i / 4 * kMaxBlocks + i % 4) << 16 | i;
  return entries;
}();
// Triangles whose boxes are at most 4 x 4 blocks. All blocks of a triangle are tested at once, one lane per
// block. The candidate blocks of many triangles go into one list: the number per triangle is hard to predict
// for a branch predictor, but a loop over a list is not.
template <class Arithmetic>
class SmallTriangles {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit SmallTriangles(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch<Arithmetic>& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++ * kBlockPixels;
    const V bx = hn::Set(d, batch.bx1[k] - batch.bx0[k]), by = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const auto in_block = [&](int i) {
      return over_block<Arithmetic>(batch.edge[i].x + k, batch.edge[i].y + k);
    };
    const Values16<Arithmetic> edge_in[3] = {in_block(0), in_block(1), in_block(2)};
    const auto depth_in = over_block<Int32Arithmetic>(batch.depth.x + k, batch.depth.y + k);
    const V entry = hn::Set(d, (batch.by0[k] * kMaxBlocks + batch.bx0[k]) << 16 | slot);
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      // The blocks of the square are arranged like the pixels of a block, at four times the distance.
      const auto store_values = [&](auto lanes, auto offset, auto first, auto& values) {
        const auto at = lanes.add(lanes.set(first), lanes.four_times(offset));
        lanes.store(offset, values.in_block + slot + lane);
        lanes.store(at, values.at_block + slot + lane);
        return at;
      };
      const auto most_of = [&](int i) {
        const auto at = store_values(Arithmetic{}, edge_in[i].v[p], batch.edge[i].first[k], edge_[i]);
        return Arithmetic::add(at, Arithmetic::set(batch.edge[i].rise[k]));
      };
      const typename Arithmetic::Vector most_values[3] = {most_of(0), most_of(1), most_of(2)};
      const V most = Arithmetic::outside(most_values[0], most_values[1], most_values[2]);
      store_values(Int32Arithmetic{}, depth_in.v[p], batch.depth.first[k], depth_);
      const auto beside =
          hn::Or(hn::Gt(hn::Load(d, kLaneX + lane), bx), hn::Gt(hn::Load(d, kLaneY + lane), by));
      const auto candidate = hn::Not(hn::Or(beside, hn::Lt(most, hn::Zero(d))));
      const V entries = hn::Add(entry, hn::Load(d, kSquareEntries + lane));
      list_.append(entries, candidate);
    }
    payload_[slot / kBlockPixels] = batch.payload[k];
  }

  HWY_INLINE void draw() {
    const D d;
    for (int n = 0; n < list_.length; ++n) {
      const int block = list_.at[n] >> 16, value_index = list_.at[n] & 0xFFFF,
                slot = value_index / kBlockPixels;
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](auto lanes, const auto& values) {
          return lanes.add(lanes.set(values.at_block[value_index]),
                           lanes.load(values.in_block + slot * kBlockPixels + p * kLanes));
        };
        const auto edge = [&](int i) { return value(Arithmetic{}, edge_[i]); };
        write_whole(tile_, block * kBlockPixels + p * kLanes,
                    inside(Arithmetic::outside(edge(0), edge(1), edge(2))), value(Int32Arithmetic{}, depth_),
                    hn::Set(d, payload_[slot]));
      }
    }
    used_ = list_.length = 0;
  }

 private:
  static constexpr int kSlots = 16;
  Tile& tile_;
  int used_ = 0;
  template <typename Value>
  struct alignas(64) SlotValues {
    Value at_block[kSlots * kBlocksAtOnce], in_block[kSlots * kBlockPixels];
  };
  SlotValues<typename Arithmetic::Value> edge_[3];
  SlotValues<std::int32_t> depth_;
  std::int32_t payload_[kSlots];
  // the block in the tile << 16 | slot * 16 + the block's index in the square
  std::int32_t candidates_[(kSlots + 1) * kBlocksAtOnce];
  List list_{candidates_};
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

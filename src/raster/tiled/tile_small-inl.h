// Draws small triangles: tests all blocks of a triangle at once, and draws the blocks of many triangles in
// one loop.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/tiled/tile_blocks-inl.h"
#include "raster/tiled/tile_setup-inl.h"

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
class SmallTriangles {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit SmallTriangles(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++ * kBlockPixels;
    const V bx = hn::Set(d, batch.bx1[k] - batch.bx0[k]), by = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const Values16 in[4] = {over_block(batch.edge[0].x + k, batch.edge[0].y + k),
                            over_block(batch.edge[1].x + k, batch.edge[1].y + k),
                            over_block(batch.edge[2].x + k, batch.edge[2].y + k),
                            over_block(batch.depth.x + k, batch.depth.y + k)};
    const V entry = hn::Set(d, (batch.by0[k] * kMaxBlocks + batch.bx0[k]) << 16 | slot);
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = hn::Zero(d);
      // The blocks of the square are arranged like the pixels of a block, at four times the distance.
      const auto at_block = [&](int i, const std::int32_t* first) {
        const V at = hn::Add(hn::Set(d, *first), hn::ShiftLeft<2>(in[i].v[p]));
        hn::Store(in[i].v[p], d, in_block_[i] + slot + lane);
        hn::Store(at, d, at_block_[i] + slot + lane);
        return at;
      };
      for (int i = 0; i < 3; ++i)
        most = hn::Or(most, hn::Add(at_block(i, batch.edge[i].first + k), hn::Set(d, batch.edge[i].rise[k])));
      at_block(3, batch.depth.first + k);
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
        const auto value = [&](int i) {
          return hn::Add(hn::Set(d, at_block_[i][value_index]),
                         hn::Load(d, in_block_[i] + slot * kBlockPixels + p * kLanes));
        };
        write_whole(tile_, block * kBlockPixels + p * kLanes,
                    inside(hn::Or(hn::Or(value(0), value(1)), value(2))), value(3),
                    hn::Set(d, payload_[slot]));
      }
    }
    used_ = list_.length = 0;
  }

 private:
  static constexpr int kSlots = 16;
  Tile& tile_;
  int used_ = 0;
  alignas(64) std::int32_t at_block_[4][kSlots * kBlocksAtOnce], in_block_[4][kSlots * kBlockPixels];
  std::int32_t payload_[kSlots];
  // the block in the tile << 16 | slot * 16 + the block's index in the square
  std::int32_t candidates_[(kSlots + 1) * kBlocksAtOnce];
  List list_{candidates_};
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

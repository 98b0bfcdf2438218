// Drawing small triangles: all blocks of one are sifted at once, and blocks of many are drawn together.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/tiled/tile_blocks-inl.h"
#include "raster/tiled/tile_setup-inl.h"

// Included once a SIMD target.
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

// Where a square of blocks has its members, in the tile, from its first; and which members they are.
alignas(64) constexpr auto kSquareNames = [] {
  struct {
    std::int32_t v[kBlocksAtOnce];
    constexpr const std::int32_t* operator+(int i) const { return v + i; }
  } names{};
  for (int i = 0; i < kBlocksAtOnce; ++i) names.v[i] = (i / 4 * kMaxBlocks + i % 4) << 16 | i;
  return names;
}();
// Small triangles, whose boxes are at most 4 x 4 blocks. All blocks of one are sifted at once, and those it
// touches wait in a list that holds many triangles': how many each has is hard for a branch predictor to
// guess, and the loop over the list need not.
class SmallTriangles {
 public:
  static constexpr int kSide = 4;  // blocks
  explicit SmallTriangles(Tile& tile) : tile_(tile) {}

  HWY_INLINE void add(const Batch& batch, int k) {
    const D d;
    if (used_ == kSlots) draw();
    const int slot = used_++ * kBlockPixels;
    const V bx = hn::Set(d, batch.bx1[k] - batch.bx0[k]), by = hn::Set(d, batch.by1[k] - batch.by0[k]);
    const Sixteen in[4] = {over_block(batch.edge[0].x + k, batch.edge[0].y + k),
                           over_block(batch.edge[1].x + k, batch.edge[1].y + k),
                           over_block(batch.edge[2].x + k, batch.edge[2].y + k),
                           over_block(batch.depth.x + k, batch.depth.y + k)};
    const V name = hn::Set(d, (batch.by0[k] * kMaxBlocks + batch.bx0[k]) << 16 | slot);
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = hn::Zero(d);
      // Blocks lie in the square as pixels lie in a block, four times as far apart.
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
      const auto touched = hn::Not(hn::Or(beside, hn::Lt(most, hn::Zero(d))));
      const V names = hn::Add(name, hn::Load(d, kSquareNames + lane));
      list_.append(names, touched);
    }
    payload_[slot / kBlockPixels] = batch.payload[k];
  }

  HWY_INLINE void draw() {
    const D d;
    for (int n = 0; n < list_.length; ++n) {
      const int block = list_.at[n] >> 16, place = list_.at[n] & 0xFFFF, slot = place / kBlockPixels;
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](int i) {
          return hn::Add(hn::Set(d, at_block_[i][place]),
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
  // block << 16 | slot * 16 + the block's place in the square
  std::int32_t touched_[(kSlots + 1) * kBlocksAtOnce];
  List list_{touched_};
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

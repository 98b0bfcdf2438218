// Drawing large triangles: a row of blocks is sifted at once, by edges and by hierarchical depth.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/tile_blocks-inl.h"
#include "raster/tile_setup-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_TILE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_ROWS_INL_H
#undef EDGEWISE_TILE_ROWS_INL_H
#else
#define EDGEWISE_TILE_ROWS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

alignas(64) constexpr std::int32_t kIota[kBlocksAtOnce] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                           8, 9, 10, 11, 12, 13, 14, 15};

// Whether entry k may hold a whole block. Each edge's value rises from 0 to twice the area, and by its span
// over a block.
HWY_INLINE bool may_fill_blocks(const Batch& batch, int k) {
  const auto has_room = [&](const Batch::Linear& edge) {
    return edge.span[k] >> kSubBits <= batch.twice_area_px[k];
  };
  return has_room(batch.edge[0]) && has_room(batch.edge[1]) && has_room(batch.edge[2]);
}

// Draws entry k of the batch a row of blocks at a time: which are touched, not hidden, is found for all of
// them at once.
template <bool kHierarchicalDepth>
HWY_NOINLINE void draw_rows(Tile& tile, const Batch& batch, int k) {
  const D d;
  const V zero = hn::Zero(d);
  struct Row {
    V v[kVectors], step;
    HWY_INLINE Row(const std::int32_t* x, const std::int32_t* y, const std::int32_t* first) {
      const D di;
      for (int p = 0; p < kVectors; ++p)
        v[p] = hn::Add(hn::Set(di, *first),
                       hn::Mul(hn::Load(di, kIota + p * kLanes), hn::ShiftLeft<2>(hn::Set(di, *x))));
      step = hn::ShiftLeft<2>(hn::Set(di, *y));
    }
    HWY_INLINE void next() {
      for (V& part : v) part = hn::Add(part, step);
    }
  };
  const auto row = [&](const auto& f) { return Row(f.x + k, f.y + k, f.first + k); };
  Row edge[3] = {row(batch.edge[0]), row(batch.edge[1]), row(batch.edge[2])};
  Row depth = row(batch.depth), nearest = row(batch.nearest);
  const auto in_block = [&](const auto& f) { return over_block(f.x + k, f.y + k); };
  const Sixteen edge_in[3] = {in_block(batch.edge[0]), in_block(batch.edge[1]), in_block(batch.edge[2])};
  const Sixteen depth_in = in_block(batch.depth);
  const V payload = hn::Set(d, batch.payload[k]);
  const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]);

  // Values at the first pixels of blocks, and the blocks that are touched, by their places after the first.
  alignas(64) std::int32_t at_edge[3][kMaxBlocks * kMaxBlocks], at_depth[kMaxBlocks * kMaxBlocks];
  std::int32_t touched[kMaxBlocks * kMaxBlocks + kLanes];
  List list{touched};
  const int corner = batch.by0[k] * kMaxBlocks + batch.bx0[k];
  const int end = (batch.by1[k] - batch.by0[k] + 1) * kMaxBlocks;
  for (int start = 0; start < end; start += kMaxBlocks) {
    for (int p = 0; p < kVectors; ++p) {
      const int lane = p * kLanes;
      V most = zero, least = zero;
      for (int i = 0; i < 3; ++i) {
        const V high = hn::Add(edge[i].v[p], hn::Set(d, batch.edge[i].rise[k]));
        most = hn::Or(most, high);
        least = hn::Or(least, hn::Sub(high, hn::Set(d, batch.edge[i].span[k])));
        hn::Store(edge[i].v[p], d, at_edge[i] + start + lane);
      }
      hn::Store(depth.v[p], d, at_depth + start + lane);
      const V column = hn::Load(d, kIota + lane);
      const auto outside = hn::Or(hn::Gt(column, last_column), hn::Lt(most, zero));
      auto seen = hn::Not(outside);
      if constexpr (kHierarchicalDepth) {
        // No pixel of a block that lies inside is farther, from now on, than the triangle's own farthest
        // there.
        std::int32_t* farthest = tile.farthest + corner + start + lane;
        const V old_farthest = hn::LoadU(d, farthest);
        const V own_farthest = hn::Add(depth.v[p], hn::Set(d, batch.depth.rise[k]));
        const auto crossed = hn::Or(outside, hn::Lt(least, zero));
        hn::StoreU(hn::IfThenElse(crossed, old_farthest, hn::Min(old_farthest, own_farthest)), d, farthest);
        seen = hn::And(seen, hn::Lt(nearest.v[p], old_farthest));
      }
      list.append(hn::Add(column, hn::Set(d, start)), seen);
    }
    for (Row& e : edge) e.next();
    depth.next();
    nearest.next();
  }
  for (int n = 0; n < list.length; ++n) {
    const int block = touched[n];
    for (int p = 0; p < kVectors; ++p) {
      const auto value = [&](const std::int32_t* at_block, const Sixteen& in) {
        return hn::Add(hn::Set(d, at_block[block]), in.v[p]);
      };
      const V outside = hn::Or(hn::Or(value(at_edge[0], edge_in[0]), value(at_edge[1], edge_in[1])),
                               value(at_edge[2], edge_in[2]));
      write(tile, (corner + block) * kBlockPixels + p * kLanes, outside, value(at_depth, depth_in), payload);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

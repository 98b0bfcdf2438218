// Coarse rejection for large triangles: tests a row of blocks at once and lists the candidates, the blocks
// that are neither outside an edge nor occluded.
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_candidates-inl.h"
#include "raster/edges/tile_setup-inl.h"

// Included once per SIMD target.
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
alignas(64) constexpr std::int32_t kBlockX[kBlocksAtOnce] = {0,  4,  8,  12, 16, 20, 24, 28,  // px
                                                             32, 36, 40, 44, 48, 52, 56, 60};
HWY_INLINE std::size_t lane_of(std::size_t p) {
  return p * static_cast<std::size_t>(kLanes);
}

// Whether triangle k may cover a whole block: inside a triangle an edge value lies between 0 and twice the
// area, so its range over the block must not exceed that (claim may_fill_blocks in proofs/tile_reject.smt2).
template <class Arithmetic>
HWY_INLINE bool may_fill_blocks(const Batch<Arithmetic>& batch, int k) {
  const auto has_room = [&](const auto& edge) {
    return !Arithmetic::spans_more(edge.range[k], batch.twice_area_px[k]);
  };
  return has_room(batch.edge[0]) && has_room(batch.edge[1]) && has_room(batch.edge[2]);
}

// A linear function of the pixel position, at the first pixels of a row of blocks, in kWidth vectors.
template <class Lanes, std::size_t kWidth>
struct Row {
  using Value = typename Lanes::Value;
  typename Lanes::Vector v[kWidth], step;
  HWY_INLINE Row(const Value* x, const Value* y, const Value* first) {
    for (std::size_t p = 0; p < kWidth; ++p)
      v[p] = Lanes::add(Lanes::set(*first), Lanes::times(hn::Load(D{}, kBlockX + lane_of(p)), *x));
    step = Lanes::times(hn::Set(D{}, kBlockSide), *y);
  }
  HWY_INLINE void next() {
    for (auto& value : v) value = Lanes::add(value, step);
  }
};

// Lists the candidate blocks of triangle k, whose box is at most kWidth vectors of blocks wide, and lowers
// the zmax of the blocks that it covers.
template <class Arithmetic, bool kHierarchicalDepth, std::size_t kWidth>
HWY_NOINLINE void find_candidates_by_rows(Tile& tile, const Batch<Arithmetic>& batch, int k,
                                          Candidates& out) {
  const D d;
  const V minus_one = hn::Set(d, -1);
  const auto largest = [&](const auto& edge) {
    return Row<Arithmetic, kWidth>(edge.x + k, edge.y + k, edge.most + k);
  };
  Row<Arithmetic, kWidth> edge[3] = {largest(batch.edge[0]), largest(batch.edge[1]), largest(batch.edge[2])};
  Row<Int32Arithmetic, kWidth> depth(batch.depth.x + k, batch.depth.y + k, batch.depth.most + k);
  Row<Int32Arithmetic, kWidth> nearest(batch.nearest.x + k, batch.nearest.y + k, batch.nearest.first + k);

  const V last_column = hn::Set(d, batch.bx1[k] - batch.bx0[k]);
  V before_end[kWidth], offset[kWidth];  // before_end < 0 behind the box's last column
  for (std::size_t p = 0; p < kWidth; ++p) {
    offset[p] = hn::Load(d, kIota + lane_of(p));
    before_end[p] = hn::Sub(last_column, offset[p]);
  }
  std::int32_t* hiz = tile.hiz.at(batch.bx0[k], batch.by0[k]);
  List list{out.offset};
  for (int row = batch.by0[k]; row <= batch.by1[k]; ++row) {
    for (std::size_t p = 0; p < kWidth; ++p) {
      const V most = hn::Or(Arithmetic::outside(edge[0].v[p], edge[1].v[p], edge[2].v[p]), before_end[p]);
      auto candidate = hn::Gt(most, minus_one);
      if constexpr (kHierarchicalDepth) {
        // In a block that the triangle covers, no pixel stays farther than the triangle's farthest depth.
        const auto low = [&](int i) {
          return Arithmetic::subtract(edge[i].v[p], Arithmetic::set(batch.edge[i].range[k]));
        };
        const V least = hn::Or(Arithmetic::outside(low(0), low(1), low(2)), before_end[p]);
        const V old_zmax = hn::LoadU(d, hiz + lane_of(p)), own_zmax = depth.v[p];
        const auto inside = hn::Gt(least, minus_one);
        hn::StoreU(hn::IfThenElse(inside, hn::Min(old_zmax, own_zmax), old_zmax), d, hiz + lane_of(p));
        candidate = hn::And(candidate, hn::Lt(nearest.v[p], old_zmax));
      }
      list.append(offset[p], candidate);
      offset[p] = hn::Add(offset[p], hn::Set(d, kMaxBlocks));
    }
    for (auto& e : edge) e.next();
    if constexpr (kHierarchicalDepth) depth.next(), nearest.next();
    hiz += kMaxBlocks;
  }
  out.length = list.length;
  out.k = k;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

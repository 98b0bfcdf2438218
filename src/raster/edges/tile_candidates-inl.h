// Draws the candidate blocks of a large triangle from a list.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/edges/tile_blocks-inl.h"
#include "raster/edges/tile_setup-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_CANDIDATES_INL_H
#undef EDGEWISE_TILE_CANDIDATES_INL_H
#else
#define EDGEWISE_TILE_CANDIDATES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// The candidate blocks of triangle k of a batch, in the order of the tile's blocks. Offsets count blocks of
// the tile from the first block of the triangle's box.
struct Candidates {
  alignas(64) std::int32_t offset[kMaxBlocks * kMaxBlocks + kLanes];
  int length, k;
};

template <class Arithmetic>
HWY_NOINLINE void draw_candidates(Tile& tile, const Batch<Arithmetic>& batch, const Candidates& candidates) {
  const int length = candidates.length, k = candidates.k;
  if (length == 0) return;
  const D d;
  const auto in_block = [&](const auto& edge) { return over_block<Arithmetic>(edge.x + k, edge.y + k); };
  const Values16<Arithmetic> edge_in[3] = {in_block(batch.edge[0]), in_block(batch.edge[1]),
                                           in_block(batch.edge[2])};
  const auto depth_in = over_block<Int32Arithmetic>(batch.depth.x + k, batch.depth.y + k);
  const V payload = hn::Set(d, batch.payload[k]);
  const int first_block = batch.by0[k] * kMaxBlocks + batch.bx0[k];
  for (int begin = 0; begin < length; begin += kLanes) {
    // Values at the blocks' first pixels, through memory: from AVX2 on, a load broadcasts one to all lanes
    // without the execution units for arithmetic and shuffles, which are the bottleneck.
    const V offset = hn::Load(d, candidates.offset + begin);
    static_assert(kBlockSide == 1 << 2 && kMaxBlocks == 1 << 4);
    const V x = hn::ShiftLeft<2>(hn::And(offset, hn::Set(d, kMaxBlocks - 1)));
    const V y = hn::ShiftLeft<2>(hn::ShiftRight<4>(offset));
    alignas(64) typename Arithmetic::Value edge_at[3][kLanes];
    alignas(64) std::int32_t depth_at[kLanes];
    const auto store_first = [&](auto lanes, const auto& f, auto* at) {
      lanes.store(lanes.add(lanes.set(f.first[k]), lanes.add(lanes.times(x, f.x[k]), lanes.times(y, f.y[k]))),
                  at);
    };
    for (int i = 0; i < 3; ++i) store_first(Arithmetic{}, batch.edge[i], edge_at[i]);
    store_first(Int32Arithmetic{}, batch.depth, depth_at);
    const int count = std::min(kLanes, length - begin);
    for (int n = 0; n < count; ++n) {
      const int block = first_block + candidates.offset[begin + n];
      const typename Arithmetic::Vector edge[3] = {
          Arithmetic::set(edge_at[0][n]), Arithmetic::set(edge_at[1][n]), Arithmetic::set(edge_at[2][n])};
      const V depth = hn::Set(d, depth_at[n]);
      for (int p = 0; p < kVectors; ++p) {
        const auto value = [&](int i) { return Arithmetic::add(edge[i], edge_in[i].v[p]); };
        write(tile, block * kBlockPixels + p * kLanes,
              inside(Arithmetic::outside(value(0), value(1), value(2))), hn::Add(depth, depth_in.v[p]),
              payload);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

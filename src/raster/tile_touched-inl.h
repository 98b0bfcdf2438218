// Drawing the blocks that a large triangle touches, from a list of them.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/tile_blocks-inl.h"
#include "raster/tile_setup-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_TILE_TOUCHED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_TOUCHED_INL_H
#undef EDGEWISE_TILE_TOUCHED_INL_H
#else
#define EDGEWISE_TILE_TOUCHED_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// The blocks that entry k of a batch touches, in the order of the tile's blocks, from the box's first one on.
struct Touched {
  alignas(64) std::int32_t place[kMaxBlocks * kMaxBlocks + kLanes];
  int length, k;
};

HWY_NOINLINE void draw_touched(Tile& tile, const Batch& batch, const Touched& touched) {
  const int length = touched.length, k = touched.k;
  if (length == 0) return;
  const D d;
  // Values at the blocks' first pixels.
  alignas(64) std::int32_t at_edge[3][kMaxBlocks * kMaxBlocks], at_depth[kMaxBlocks * kMaxBlocks];
  for (int n = 0; n < length; n += kLanes) {
    const V place = hn::Load(d, touched.place + n);
    static_assert(kBlock == 1 << 2 && kMaxBlocks == 1 << 4);
    const V x = hn::ShiftLeft<2>(hn::And(place, hn::Set(d, kMaxBlocks - 1)));
    const V y = hn::ShiftLeft<2>(hn::ShiftRight<4>(place));
    const auto at_first = [&](const Batch::Linear& f) {
      return hn::Add(hn::Set(d, f.first[k]),
                     hn::Add(hn::Mul(x, hn::Set(d, f.x[k])), hn::Mul(y, hn::Set(d, f.y[k]))));
    };
    for (int i = 0; i < 3; ++i) hn::Store(at_first(batch.edge[i]), d, at_edge[i] + n);
    hn::Store(at_first(batch.depth), d, at_depth + n);
  }
  const auto in_block = [&](const auto& f) { return over_block(f.x + k, f.y + k); };
  const Sixteen edge_in[3] = {in_block(batch.edge[0]), in_block(batch.edge[1]), in_block(batch.edge[2])};
  const Sixteen depth_in = in_block(batch.depth);
  const V payload = hn::Set(d, batch.payload[k]);
  const int first_place = batch.by0[k] * kMaxBlocks + batch.bx0[k];
  for (int n = 0; n < length; ++n) {
    const int block = first_place + touched.place[n];
    for (int p = 0; p < kVectors; ++p) {
      const auto value = [&](const std::int32_t* at_block, const Sixteen& in) {
        return hn::Add(hn::Set(d, at_block[n]), in.v[p]);
      };
      const V outside = hn::Or(hn::Or(value(at_edge[0], edge_in[0]), value(at_edge[1], edge_in[1])),
                               value(at_edge[2], edge_in[2]));
      write(tile, block * kBlockPixels + p * kLanes, outside, value(at_depth, depth_in), payload);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

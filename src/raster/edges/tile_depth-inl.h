// The depth planes of the tile kernel (rule 6), stepped in wrapping int32. The scalar functions of contract.h
// recompute lanes whose depth gradient is too large for doubles (depth_lanes-inl.h).
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "edgewise/contract.h"
#include "raster/edges/tile_linear-inl.h"
#include "raster/kernels.h"
#include "raster/simd/depth_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_DEPTH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_DEPTH_INL_H
#undef EDGEWISE_TILE_DEPTH_INL_H
#else
#define EDGEWISE_TILE_DEPTH_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// For HiZ: no pixel that a triangle covers in a block is nearer than this linear function of the block's
// first pixel.
struct NearestDepth {
  std::int32_t x[kBatch], y[kBatch], first[kBatch];
  std::int32_t least[kBatch];  // over all blocks of the box
};

// Stores the plane and the nearest depth of triangle k. `left`, `top`: the first pixel of the box's blocks,
// from the tile's. `across`, `down`: blocks from the first to the last.
template <class Batch>
void set_up_one_depth(const TileTask& task, const Oriented& t, int left, int top, int across, int down,
                      Batch& out, int k) {
  const DepthPlane plane = make_depth(t);
  const std::int32_t zx = wrap(plane.zx), zy = wrap(plane.zy),
                     z = wrap(plane.at(task.x0 + left, task.y0 + top));
  set_linear(out.depth, k, zx, zy, z);
  const bool flat = std::max(std::abs(std::int64_t{zx}), std::abs(std::int64_t{zy})) < kSteep;
  const std::int64_t nearest = std::min({t.z[0], t.z[1], t.z[2]}) - kDepthError;
  out.nearest.x[k] = flat ? zx : 0;
  out.nearest.y[k] = flat ? zy : 0;
  const auto bits = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
  out.nearest.first[k] = flat ? wrap(bits(z) + bits(out.depth.rise[k]) - bits(out.depth.range[k]))
                              : static_cast<std::int32_t>(nearest);
  const auto falls = [&](std::int32_t step, int count) {
    return bits(std::min(step, 0)) * static_cast<std::uint32_t>(kBlockSide * count);
  };
  out.nearest.least[k] =
      wrap(bits(out.nearest.first[k]) + falls(out.nearest.x[k], across) + falls(out.nearest.y[k], down));
}

#if HWY_TARGET != HWY_SCALAR
struct HalfDepth {
  HalfLinear plane, nearest;
};
// The same for half a vector of triangles. A triangle whose bit in the result is 0 has a gradient that is
// not exact in doubles, so set_up_one_depth() must recompute it.
HWY_INLINE std::uint32_t set_up_half_depth(const TileTask& task, const TriangleLanes& t, const Area& area,
                                           V32 left, V32 top, HalfDepth& out) {
  const int in_cell_x = task.x0 % kDepthCell, in_cell_y = task.y0 % kDepthCell;
  const DepthLanes depth = depth_lanes(t, area, task.x0 - in_cell_x, task.y0 - in_cell_y);
  const V32 zx = depth.x, zy = depth.y;
  const V32 first = lower(hn::Add(as64(depth.base()), hn::Add(product(zx, hn::Add(left, set32(in_cell_x))),
                                                              product(zy, hn::Add(top, set32(in_cell_y))))));
  out.plane = {zx, zy, first};

  const auto flat = depth.is_flat();
  const V32 least =
      hn::Add(first, thrice(hn::Add(hn::Min(zx, hn::Zero(D32{})), hn::Min(zy, hn::Zero(D32{})))));
  out.nearest = {hn::IfThenElseZero(flat, zx), hn::IfThenElseZero(flat, zy),
                 hn::IfThenElse(flat, least, nearest_vertex(t))};
  return mask_bits(depth.exact);
}
template <class Batch>
HWY_INLINE void store_depth(const HalfDepth& left, const HalfDepth& right, V across, V down, Batch& out,
                            int k) {
  store_linear(left.plane, right.plane, out.depth, k);
  const auto store_both = [&](V32 l, V32 r, std::int32_t* list) {
    const V v = both(l, r);
    hn::Store(v, D{}, list + k);
    return v;
  };
  const V x = store_both(left.nearest.x, right.nearest.x, out.nearest.x);
  const V y = store_both(left.nearest.y, right.nearest.y, out.nearest.y);
  const V first = store_both(left.nearest.first, right.nearest.first, out.nearest.first);
  const auto falls = [](V step, V blocks) { return hn::Mul(hn::Min(step, hn::Zero(D{})), blocks); };
  const V fall = hn::Add(falls(x, across), falls(y, down));
  static_assert(kBlockSide == 1 << 2);
  hn::Store(hn::Add(first, hn::ShiftLeft<2>(fall)), D{}, out.nearest.least + k);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

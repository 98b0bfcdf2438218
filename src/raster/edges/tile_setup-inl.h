// Sets triangles up for one tile, a vector of triangles at a time.
//
// `Arithmetic` sets up the edges (tile_arithmetic-inl.h); tile_depth-inl.h sets up the depths.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/binning/cell_boxes.h"
#include "raster/edges/tile_arithmetic-inl.h"
#include "raster/edges/tile_depth-inl.h"
#include "raster/kernels.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_SETUP_INL_H
#undef EDGEWISE_TILE_SETUP_INL_H
#else
#define EDGEWISE_TILE_SETUP_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// A batch of triangles, set up for one tile.
template <class Arithmetic>
struct alignas(64) Batch {
  Linear<typename Arithmetic::Value> edge[3];
  Linear<std::int32_t> depth;
  NearestDepth nearest;
  std::int32_t payload[kBatch];
  std::int32_t twice_area_px[kBatch];
  std::int32_t bx0[kBatch], by0[kBatch], bx1[kBatch], by1[kBatch];  // the box in blocks, inclusive
};

// Scalar set-up of one triangle. Returns false if it covers no pixel of the tile.
template <class Arithmetic>
bool set_up_one(const TileTask& task, std::uint32_t index, Batch<Arithmetic>& out, int k) {
  const ScreenTriangle& triangle = task.triangles[index];
  const int size = task.size();
  const PixelBox box = pixel_box(triangle, task.part.frame.width, task.part.frame.height);
  const int x0 = std::max(box.x0 - task.x0, 0), x1 = std::min(box.x1 - task.x0, size);
  const int y0 = std::max(box.y0 - task.y0, 0), y1 = std::min(box.y1 - task.y0, size);
  if (x0 >= x1 || y0 >= y1) return false;
  const Oriented t = orient(triangle);
  if (t.area == 0) return false;
  const int bx0 = x0 / kBlockSide, bx1 = (x1 - 1) / kBlockSide, by0 = y0 / kBlockSide,
            by1 = (y1 - 1) / kBlockSide;

  const int left = bx0 * kBlockSide, top = by0 * kBlockSide;
  const BlockBox blocks{left, top, (bx1 - bx0 + 1) * kBlockSide - 1, (by1 - by0 + 1) * kBlockSide - 1};
  if (!Arithmetic::set_up_one(task, t, blocks, out.edge, k)) return false;
  set_up_one_depth(task, t, left, top, bx1 - bx0, by1 - by0, out, k);
  out.payload[k] = wrap(triangle.payload);
  out.twice_area_px[k] = static_cast<std::int32_t>(t.area >> 2 * kSubBits);
  out.bx0[k] = bx0, out.by0[k] = by0, out.bx1[k] = bx1, out.by1[k] = by1;
  return true;
}

#if HWY_TARGET != HWY_SCALAR

template <class Arithmetic>
struct HalfBatch {
  typename Arithmetic::HalfEdges edges;
  HalfDepth depth;
  V32 payload, twice_area_px, bx0, by0, bx1, by1;
  std::uint32_t alive, has_depth;  // one bit per triangle: not rejected; depth is valid
};

// set_up_one() for half a vector of triangles. Lanes whose bit in `has_depth` is 0 have no valid depth.
template <class Arithmetic>
HWY_INLINE void set_up_half(const TileTask& task, const std::uint32_t* indices, HalfBatch<Arithmetic>& out) {
  const D64 d;
  const TriangleLanes t = load(task.triangles, indices);
  const BoxLanes box(t.x, t.y, {task.x0, task.y0, task.x0 + task.width(), task.y0 + task.height()});
  const V32 x0 = hn::Sub(box.x0, set32(task.x0)), x1 = hn::Sub(box.x1, set32(task.x0));
  const V32 y0 = hn::Sub(box.y0, set32(task.y0)), y1 = hn::Sub(box.y1, set32(task.y0));
  static_assert(kBlockSide == 1 << 2);
  const V32 one = set32(1);
  const V32 bx0 = hn::ShiftRight<2>(x0), bx1 = hn::ShiftRight<2>(hn::Sub(x1, one));
  const V32 by0 = hn::ShiftRight<2>(y0), by1 = hn::ShiftRight<2>(hn::Sub(y1, one));
  const V32 left = hn::ShiftLeft<2>(bx0), top = hn::ShiftLeft<2>(by0);
  const auto last = [&](V32 b0, V32 b1) {
    return hn::Sub(hn::ShiftLeft<2>(hn::Add(hn::Sub(b1, b0), one)), one);
  };

  const V64 zero = hn::Zero(d);
  const Area area = area_of(t);
  // A lane whose sign bit is set is rejected.
  V64 dead = hn::Or(hn::ShiftLeft<32>(as64(hn::VecFromMask(D32{}, hn::Not(box.filled)))),
                    hn::VecFromMask(d, hn::Eq(area.value, zero)));
  const BlockBoxLanes blocks{left, top, last(bx0, bx1), last(by0, by1)};
  dead = hn::Or(dead, Arithmetic::set_up_half(task, t, area, blocks, out.edges));

  out.has_depth = set_up_half_depth(task, t, area, left, top, out.depth);
  out.payload = t.payload, out.twice_area_px = lower(shift_right<2 * kSubBits>(area.value));
  out.bx0 = bx0, out.by0 = by0, out.bx1 = bx1, out.by1 = by1;
  out.alive = mask_bits(hn::Not(hn::Lt(dead, zero)));
}

// Sets up triangles[indices[i]] for i = k … k + kLanes - 1. Bit i - k of the result is set if the triangle is
// not rejected. From `count` on, indices are padding but must be valid; a half vector of padding is skipped.
template <class Arithmetic>
HWY_INLINE std::uint32_t set_up_vector(const TileTask& task, const std::uint32_t* indices, int count,
                                       Batch<Arithmetic>& out, int k) {
  constexpr int kInHalf = kLanes / 2;
  HalfBatch<Arithmetic> left, right;
  set_up_half(task, indices + k, left);
  if (k + kInHalf < count)
    set_up_half(task, indices + k + kInHalf, right);
  else
    right = left, right.alive = 0;

  const std::uint32_t kept = Arithmetic::store_edges(left.edges, right.edges, out.edge, k);
  const auto store_both = [&](V32 l, V32 r, std::int32_t* list) {
    const V v = both(l, r);
    hn::Store(v, D{}, list + k);
    return v;
  };
  store_both(left.payload, right.payload, out.payload);
  store_both(left.twice_area_px, right.twice_area_px, out.twice_area_px);
  const V bx0 = store_both(left.bx0, right.bx0, out.bx0), bx1 = store_both(left.bx1, right.bx1, out.bx1);
  const V by0 = store_both(left.by0, right.by0, out.by0), by1 = store_both(left.by1, right.by1, out.by1);
  store_depth(left.depth, right.depth, hn::Sub(bx1, bx0), hn::Sub(by1, by0), out, k);

  const std::uint32_t alive = (left.alive | right.alive << kInHalf) & kept;
  const std::uint32_t has_depth = left.has_depth | right.has_depth << kInHalf;
  for (std::uint32_t left_over = alive & ~has_depth; left_over != 0; left_over &= left_over - 1) {
    const int lane = std::countr_zero(left_over);
    set_up_one(task, indices[k + lane], out, k + lane);
  }
  return alive;
}

#endif

// Sets up triangles[indices[i]] for all i. Bit i of the result is set if the triangle is not rejected.
template <class Arithmetic>
std::uint32_t set_up(const TileTask& task, std::span<const std::uint32_t> indices, Batch<Arithmetic>& out) {
  const int count = static_cast<int>(indices.size());
#if HWY_TARGET == HWY_SCALAR
  std::uint32_t alive = 0;
  for (int k = 0; k < count; ++k)
    alive |= std::uint32_t{set_up_one(task, indices[static_cast<std::size_t>(k)], out, k)} << k;
  return alive;
#else
  const auto set_up_some = [&](const std::uint32_t* padded, int k) {
    return BatchBits{set_up_vector(task, padded, count, out, k), 0};
  };
  return set_up_batch<kLanes>(indices, set_up_some).drawn;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

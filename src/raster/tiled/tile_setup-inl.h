// Sets triangles up for one tile, a vector of triangles at a time.
//
// Edge values are sums of 32 x 32 -> 64 bit products (triangle_lanes-inl.h). The scalar functions of
// contract.h recompute lanes whose depth gradient is too large for doubles (depth_lanes-inl.h).
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"
#include "raster/tile_task.h"

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

constexpr int kBlockSide = 4;  // px; the kernel draws and rejects in blocks of 4 x 4 px

constexpr std::int32_t wrap(std::uint32_t v) {
  return static_cast<std::int32_t>(v);
}

// A batch of triangles, set up for one tile. Edges and depth are linear functions of the pixel position, in
// wrapping int32. Edge values are shifted (rule 5); a pixel is inside where all three are >= 0.
struct alignas(64) Batch {
  static constexpr int kSize = 32;
  struct Linear {
    std::int32_t x[kSize], y[kSize];  // steps per pixel
    std::int32_t first[kSize];        // at the first pixel of block (bx0, by0)
    std::int32_t most[kSize];         // the largest value in that block: first + rise
    std::int32_t rise[kSize];         // the largest value in a block less that at its first pixel
    std::int32_t span[kSize];         // the largest value in a block less the smallest
  } edge[3], depth;
  // For HiZ: no pixel that the triangle covers in a block is nearer than this linear function of the block's
  // first pixel.
  struct Bound {
    std::int32_t x[kSize], y[kSize], first[kSize];
    std::int32_t least[kSize];  // over all blocks of the box
  } nearest;
  std::int32_t payload[kSize];
  std::int32_t twice_area_px[kSize];
  std::int32_t bx0[kSize], by0[kSize], bx1[kSize], by1[kSize];  // the box in blocks, inclusive
};

inline void set(Batch::Linear& f, int k, std::int32_t x, std::int32_t y, std::int32_t first) {
  const auto up = [](std::int32_t step) { return step > 0 ? static_cast<std::uint32_t>(step) : 0u; };
  const auto down = [](std::int32_t step) { return step < 0 ? 0u - static_cast<std::uint32_t>(step) : 0u; };
  const std::uint32_t rise = (kBlockSide - 1) * (up(x) + up(y)),
                      fall = (kBlockSide - 1) * (down(x) + down(y));
  f.x[k] = x, f.y[k] = y, f.first[k] = first, f.most[k] = wrap(static_cast<std::uint32_t>(first) + rise);
  f.rise[k] = wrap(rise), f.span[k] = wrap(rise + fall);
}

// Scalar set-up of one triangle. Returns false if it covers no pixel of the tile.
inline bool set_up_one(const TileTask& task, const ScreenTriangle& triangle, Batch& out, int k) {
  const int size = task.size();
  const PixelBox box = pixel_box(triangle, task.frame.width, task.frame.height);
  const int x0 = std::max(box.x0 - task.x0, 0), x1 = std::min(box.x1 - task.x0, size);
  const int y0 = std::max(box.y0 - task.y0, 0), y1 = std::min(box.y1 - task.y0, size);
  if (x0 >= x1 || y0 >= y1) return false;
  const Oriented t = orient(triangle);
  if (t.area == 0) return false;
  const int bx0 = x0 / kBlockSide, bx1 = (x1 - 1) / kBlockSide, by0 = y0 / kBlockSide,
            by1 = (y1 - 1) / kBlockSide;

  // The box is extended to whole blocks, so that an edge that accepts it accepts every lane that is tested.
  const int left = bx0 * kBlockSide, top = by0 * kBlockSide;
  const std::int64_t last_x = (bx1 - bx0 + 1) * kBlockSide - 1, last_y = (by1 - by0 + 1) * kBlockSide - 1;
  for (int i = 0; i < 3; ++i) {
    const Edge edge = make_edge(t, i);
    const std::int64_t first = edge.at(task.x0 + left, task.y0 + top);
    const std::int64_t across = std::int64_t{edge.a} * kSub * last_x,
                       down = std::int64_t{edge.b} * kSub * last_y;
    if (first + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(down, 0) < 0) return false;
    const bool accepts = first + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(down, 0) >= 0;
    accepts ? set(out.edge[i], k, 0, 0, 0)
            : set(out.edge[i], k, edge.a, edge.b, wrap(static_cast<std::uint32_t>(first >> kSubBits)));
  }
  const DepthPlane plane = make_depth(t);
  const std::int32_t zx = wrap(plane.zx), zy = wrap(plane.zy),
                     z = wrap(plane.at(task.x0 + left, task.y0 + top));
  set(out.depth, k, zx, zy, z);
  const bool flat = std::max(std::abs(std::int64_t{zx}), std::abs(std::int64_t{zy})) < kSteep;
  const std::int64_t nearest = std::min({t.z[0], t.z[1], t.z[2]}) - kDepthError;
  out.nearest.x[k] = flat ? zx : 0;
  out.nearest.y[k] = flat ? zy : 0;
  const auto bits = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
  out.nearest.first[k] = flat ? wrap(bits(z) + bits(out.depth.rise[k]) - bits(out.depth.span[k]))
                              : static_cast<std::int32_t>(nearest);
  const auto falls = [&](std::int32_t step, int blocks) {
    return bits(std::min(step, 0)) * static_cast<std::uint32_t>(kBlockSide * blocks);
  };
  out.nearest.least[k] = wrap(bits(out.nearest.first[k]) + falls(out.nearest.x[k], bx1 - bx0) +
                              falls(out.nearest.y[k], by1 - by0));
  out.payload[k] = wrap(triangle.payload);
  out.twice_area_px[k] = static_cast<std::int32_t>(t.area >> 2 * kSubBits);
  out.bx0[k] = bx0, out.by0[k] = by0, out.bx1[k] = bx1, out.by1[k] = by1;
  return true;
}

#if HWY_TARGET != HWY_SCALAR

// Half a vector of triangles, one per 64-bit lane. In V32 only the lower half of each 64-bit lane counts.
struct HalfBatch {
  struct Linear {
    V32 x, y, first;
  } edge[3], depth, nearest;
  V32 payload, twice_area_px, bx0, by0, bx1, by1;
  std::uint32_t alive, exact;  // one bit per triangle: not rejected; gradients exact in doubles
};
HWY_INLINE V both(V32 left, V32 right) {
  return hn::ConcatEven(D{}, right, left);
}

HWY_INLINE V32 thrice(V32 v) {
  static_assert(kBlockSide - 1 == 3);
  return hn::Add(v, hn::Add(v, v));
}

HWY_INLINE void set_up_depth(const TileTask& task, const TriangleLanes& t, const Area& area, V32 left,
                             V32 top, HalfBatch& out) {
  const int in_cell_x = task.x0 % kDepthCell, in_cell_y = task.y0 % kDepthCell;
  const DepthLanes depth = depth_lanes(t, area, task.x0 - in_cell_x, task.y0 - in_cell_y);
  const V32 zx = depth.x, zy = depth.y;
  const V32 first = lower(hn::Add(as64(depth.base()), hn::Add(product(zx, hn::Add(left, set32(in_cell_x))),
                                                              product(zy, hn::Add(top, set32(in_cell_y))))));
  out.depth = {zx, zy, first};

  const auto flat = depth.is_flat();
  const V32 least =
      hn::Add(first, thrice(hn::Add(hn::Min(zx, hn::Zero(D32{})), hn::Min(zy, hn::Zero(D32{})))));
  out.nearest = {hn::IfThenElseZero(flat, zx), hn::IfThenElseZero(flat, zy),
                 hn::IfThenElse(flat, least, nearest_vertex(t))};
  out.exact = mask_bits(depth.exact);
}

// set_up_one() for half a vector of triangles. Lanes whose bit in `exact` is 0 have no valid depth.
HWY_INLINE void set_up_half(const TileTask& task, const std::uint32_t* indices, HalfBatch& out) {
  const D64 d;
  const TriangleLanes t = load(task.triangles, indices);
  const auto& [x, y, z, payload] = t;

  const auto [x0, x1] = sample_range(x, task.x0, task.width());
  const auto [y0, y1] = sample_range(y, task.y0, task.height());
  const auto filled = hn::And(hn::Lt(x0, x1), hn::Lt(y0, y1));
  static_assert(kBlockSide == 1 << 2);
  const V32 one = set32(1);
  const V32 bx0 = hn::ShiftRight<2>(x0), bx1 = hn::ShiftRight<2>(hn::Sub(x1, one));
  const V32 by0 = hn::ShiftRight<2>(y0), by1 = hn::ShiftRight<2>(hn::Sub(y1, one));
  const V32 left = hn::ShiftLeft<2>(bx0), top = hn::ShiftLeft<2>(by0);
  const auto last = [&](V32 b0, V32 b1) {
    return hn::Sub(hn::ShiftLeft<2>(hn::Add(hn::Sub(b1, b0), one)), one);
  };
  const V32 last_x = last(bx0, bx1), last_y = last(by0, by1);
  const auto sample = [](V32 px, int origin) {
    return hn::Add(hn::ShiftLeft<kSubBits>(px), set32(sample_sub(origin)));
  };
  const V32 sample_x = sample(left, task.x0), sample_y = sample(top, task.y0);

  const V64 zero = hn::Zero(d);
  const Area area = area_of(t);
  const V64 flip = area.flip;
  // A lane whose sign bit is set is rejected.
  V64 dead = hn::Or(hn::ShiftLeft<32>(as64(hn::VecFromMask(D32{}, hn::Not(filled)))),
                    hn::VecFromMask(d, hn::Eq(area.value, zero)));

  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const V32 a = flipped(hn::Sub(y[i], y[j]), lower(flip)), b = flipped(hn::Sub(x[j], x[i]), lower(flip));
    const V32 zero32 = hn::Zero(D32{});
    const auto top_left = hn::Or(hn::Gt(a, zero32), hn::And(hn::Eq(a, zero32), hn::Gt(b, zero32)));
    const V64 bias = hn::AndNot(as64(hn::VecFromMask(D32{}, top_left)), hn::Set(d, 1));
    const V64 first =
        hn::Sub(hn::Add(product(a, hn::Sub(sample_x, x[i])), product(b, hn::Sub(sample_y, y[i]))), bias);
    // rise: the largest edge value less that at the first sample, over 256. across - rise: the same for the
    // least.
    const V64 rise = hn::Add(product(hn::Max(a, zero32), last_x), product(hn::Max(b, zero32), last_y));
    const V64 most = hn::Add(first, hn::ShiftLeft<kSubBits>(rise));
    const V64 across = hn::Add(product(a, last_x), product(b, last_y));
    const V64 least = hn::Add(first, hn::ShiftLeft<kSubBits>(hn::Sub(across, rise)));
    dead = hn::Or(dead, most);
    const auto crossed = hn::Lt(least, zero);
    const auto unless_accepted = [&](V64 v) { return lower(hn::IfThenElseZero(crossed, v)); };
    out.edge[i] = {unless_accepted(as64(a)), unless_accepted(as64(b)),
                   unless_accepted(shift_right<kSubBits>(first))};
  }

  set_up_depth(task, t, area, left, top, out);
  out.payload = payload, out.twice_area_px = lower(shift_right<2 * kSubBits>(area.value));
  out.bx0 = bx0, out.by0 = by0, out.bx1 = bx1, out.by1 = by1;
  out.alive = mask_bits(hn::Not(hn::Lt(dead, zero)));
}

HWY_INLINE void store(const HalfBatch::Linear& left, const HalfBatch::Linear& right, Batch::Linear& f,
                      int k) {
  const D d;
  const V x = both(left.x, right.x), y = both(left.y, right.y), first = both(left.first, right.first);
  const V rise = thrice(hn::Add(hn::Max(x, hn::Zero(d)), hn::Max(y, hn::Zero(d))));
  hn::Store(x, d, f.x + k), hn::Store(y, d, f.y + k), hn::Store(first, d, f.first + k);
  hn::Store(rise, d, f.rise + k), hn::Store(hn::Add(first, rise), d, f.most + k);
  hn::Store(thrice(hn::Add(hn::Abs(x), hn::Abs(y))), d, f.span + k);
}

// Sets up triangles[indices[i]] for i = k … k + kLanes - 1. Bit i - k of the result is set if the triangle is
// not rejected. From `count` on, indices are padding but must be valid; a half vector of padding is skipped.
HWY_INLINE std::uint32_t set_up_vector(const TileTask& task, const std::uint32_t* indices, int count,
                                       Batch& out, int k) {
  constexpr int kInHalf = kLanes / 2;
  HalfBatch left, right;
  set_up_half(task, indices + k, left);
  if (k + kInHalf < count)
    set_up_half(task, indices + k + kInHalf, right);
  else
    right = left, right.alive = 0;

  for (int i = 0; i < 3; ++i) store(left.edge[i], right.edge[i], out.edge[i], k);
  store(left.depth, right.depth, out.depth, k);
  const auto store_both = [&](V32 l, V32 r, std::int32_t* list) {
    const V v = both(l, r);
    hn::Store(v, D{}, list + k);
    return v;
  };
  const V x = store_both(left.nearest.x, right.nearest.x, out.nearest.x);
  const V y = store_both(left.nearest.y, right.nearest.y, out.nearest.y);
  const V first = store_both(left.nearest.first, right.nearest.first, out.nearest.first);
  store_both(left.payload, right.payload, out.payload);
  store_both(left.twice_area_px, right.twice_area_px, out.twice_area_px);
  const V bx0 = store_both(left.bx0, right.bx0, out.bx0), bx1 = store_both(left.bx1, right.bx1, out.bx1);
  const V by0 = store_both(left.by0, right.by0, out.by0), by1 = store_both(left.by1, right.by1, out.by1);
  const auto falls = [](V step, V blocks) { return hn::Mul(hn::Min(step, hn::Zero(D{})), blocks); };
  const V fall = hn::Add(falls(x, hn::Sub(bx1, bx0)), falls(y, hn::Sub(by1, by0)));
  static_assert(kBlockSide == 1 << 2);
  hn::Store(hn::Add(first, hn::ShiftLeft<2>(fall)), D{}, out.nearest.least + k);

  const std::uint32_t alive = left.alive | right.alive << kInHalf;
  const std::uint32_t exact = left.exact | right.exact << kInHalf;
  for (std::uint32_t left_over = alive & ~exact; left_over != 0; left_over &= left_over - 1) {
    const int lane = std::countr_zero(left_over);
    set_up_one(task, task.triangles[indices[k + lane]], out, k + lane);
  }
  return alive;
}

#endif

// Sets up triangles[indices[i]] for all i. Bit i of the result is set if the triangle is not rejected.
inline std::uint32_t set_up(const TileTask& task, std::span<const std::uint32_t> indices, Batch& out) {
  std::uint32_t alive = 0;
  const int count = static_cast<int>(indices.size());
  if (HWY_TARGET == HWY_SCALAR || !task.ablation.vector_setup) {
    for (int k = 0; k < count; ++k)
      alive |= std::uint32_t{set_up_one(task, task.triangles[indices[static_cast<std::size_t>(k)]], out, k)}
               << k;
    return alive;
  }
#if HWY_TARGET != HWY_SCALAR
  std::uint32_t padded[Batch::kSize];
  for (int k = 0; k < Batch::kSize; ++k)
    padded[k] = indices[static_cast<std::size_t>(std::min(k, count - 1))];
  for (int k = 0; k < count; k += kLanes) alive |= set_up_vector(task, padded, count, out, k) << k;
  alive &= static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
#endif
  return alive;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

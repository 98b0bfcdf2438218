// Sets triangles up for one tile, a vector of triangles at a time.
//
// The kernel is a template on the numbers in which it computes edge functions. Here are the contract's, on
// one of its grids (core/grid.h); lab/engine has others, to measure what exactness costs.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/kernels.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"
#include "raster/tile_store-inl.h"

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

constexpr std::int32_t wrap(std::uint32_t v) {
  return static_cast<std::int32_t>(v);
}

// Linear functions of the pixel position, one per triangle of a batch.
template <typename Value>
struct Linear {
  Value x[kBatch], y[kBatch];  // steps per pixel
  Value first[kBatch];         // at the first pixel of the triangle's first block
};
template <typename Value>
struct EdgeBatch : Linear<Value> {
  Value rise[kBatch];   // the largest value in a block less that at the block's first pixel
  Value range[kBatch];  // the largest value in a block less the smallest
};

// The triangles' boxes in the tile, extended to whole blocks, so that an edge that accepts a box accepts
// every pixel that is tested.
struct BlockBoxLanes {
  V32 sample_x, sample_y;  // the first pixel's sample, sub-units
  V32 last_x, last_y;      // the last pixel, from the first, px
};

// Vectors of kLanes values of a linear function, in wrapping int32.
struct Int32Numbers {
  using Value = std::int32_t;
  using Vector = V;
  static HWY_INLINE V set(Value v) { return hn::Set(D{}, v); }
  static HWY_INLINE V load_values(const Value* at) { return hn::Load(D{}, at); }
  static HWY_INLINE void store_values(V v, Value* at) { hn::Store(v, D{}, at); }
  static HWY_INLINE V add(V a, V b) { return hn::Add(a, b); }
  static HWY_INLINE V subtract(V a, V b) { return hn::Sub(a, b); }
  static HWY_INLINE V times(V pixels, Value step) { return hn::Mul(pixels, hn::Set(D{}, step)); }
  static HWY_INLINE V four_times(V v) { return hn::ShiftLeft<2>(v); }
  // The sign bit is set where a value is negative.
  static HWY_INLINE V any_negative(V e0, V e1, V e2) { return hn::Or(hn::Or(e0, e1), e2); }
};

HWY_INLINE V32 thrice(V32 v) {
  static_assert(kBlockSide - 1 == 3);
  return hn::Add(v, hn::Add(v, v));
}

// Long edges, whose values in a box may exceed 32 bits, as exact pairs: 2^7 upper + lower. Values on the
// coarse grid fit (rule 5), and so do the upper parts. Both parts are linear functions whose start and steps
// are split, lower ones from 0 to 127. So a lower part is at most 127 (1 + 63 + 63) within the tile, and the
// carry from it at most kMostCarry.
struct LongEdges {
  static constexpr int kLowerBits = Coarse::kSpareBits;
  static constexpr std::int32_t kMostCarry = 2 * kMaxTile - 2;
  EdgeBatch<std::int32_t> upper[3];  // rise and range include the carry
  Linear<std::int32_t> lower[3];
  std::uint32_t triangles;  // bit k: triangle k has a long edge. Then all its edges are pairs
};
struct NoLongEdges {};

// A batch of triangles, set up for one tile.
template <class Numbers>
struct Batch {
  using Value = typename Numbers::Value;
  EdgeBatch<Value> edge[3];
  Linear<std::int32_t> depth;       // rule 6, in wrapping int32
  std::int32_t depth_rise[kBatch];  // as in EdgeBatch
  // For HiZ: no pixel that the triangle covers in a block is nearer than this function of the block's first
  // pixel, and none in the tile is nearer than `nearest_in_tile`.
  Linear<std::int32_t> nearest;
  std::int32_t nearest_in_tile[kBatch];
  std::int32_t payload[kBatch];
  std::int32_t twice_area_px2[kBatch];
  std::int32_t bx0[kBatch], by0[kBatch], bx1[kBatch], by1[kBatch];  // the box in blocks, inclusive
  std::conditional_t<Numbers::kHasLongEdges, LongEdges, NoLongEdges> long_edges;

  HWY_INLINE bool is_long(int k) const {
    if constexpr (Numbers::kHasLongEdges) return (long_edges.triangles >> k & 1) != 0;
    return false;
  }
  // The edges of triangle k that coarse rejection and HiZ test.
  HWY_INLINE const EdgeBatch<Value>* coarse_edges(int k) const {
    if constexpr (Numbers::kHasLongEdges)
      if (is_long(k)) return long_edges.upper;
    return edge;
  }
};

// The contract's edge functions, shifted (rule 5) in wrapping int32. A pixel is inside where all three are
// >= 0. Other numbers have the same members.
template <class G>
struct ContractNumbers : Int32Numbers {
  using Grid = G;
  static constexpr bool kHasLongEdges = std::int64_t{kMaxTile} * 4 * G::kGuardSub >= std::int64_t{1} << 31;

  // Whether a value's range over a block, in square pixels, exceeds twice the triangle's area.
  static HWY_INLINE bool exceeds(Value range, std::int32_t twice_area_px2) {
    return range >> G::kSubBits > twice_area_px2;
  }

  // Sets up the edges of a vector of triangles as entries k … An edge that accepts the box becomes the
  // constant 0. Returns the bits of the triangles whose box no edge rejects.
  static HWY_INLINE std::uint32_t set_up(const TileTask&, const TriangleLanes64<G>& t, const Area& area,
                                         const BlockBoxLanes& box, Batch<ContractNumbers>& out, int k) {
    V64 rejected = hn::Zero(D64{});
    auto is_long = hn::FirstN(D64{}, 0);
    for (int i = 0; i < 3; ++i) {
      const EdgeInBox edge(t, area, i, box);
      rejected = hn::Or(rejected, edge.largest);
      store_edge(edge.unless_accepted(as64(edge.a)), edge.unless_accepted(as64(edge.b)),
                 edge.unless_accepted(shift_right<G::kSubBits>(edge.value)), 0, out.edge[i], k);
      if constexpr (kHasLongEdges) is_long = hn::Or(is_long, edge.is_long);
    }
    if constexpr (kHasLongEdges) {
      const std::uint32_t bits = mask_bits(is_long);
      out.long_edges.triangles = (k == 0 ? 0 : out.long_edges.triangles) | bits << k;
      if (bits != 0) [[unlikely]]
        set_up_long(t, area, box, out.long_edges, k);
    }
    return ~mask_bits(hn::Lt(rejected, hn::Zero(D64{})));
  }

 private:
  struct EdgeInBox : EdgeLanes {
    V64 largest;             // the largest value in the box
    hn::Mask<D64> accepted;  // where no value in the box is negative
    hn::Mask<D64> is_long;   // where values in the box, shifted, may not fit 32 bits
    HWY_INLINE EdgeInBox(const TriangleLanes64<G>& t, const Area& area, int i, const BlockBoxLanes& box)
        : EdgeLanes(t, area, i, box.sample_x, box.sample_y) {
      const V32 zero = hn::Zero(D32{});
      // From the first sample to others in the box, the value grows by at most `growth`.
      const V64 growth =
          hn::Add(product(hn::Max(a, zero), box.last_x), product(hn::Max(b, zero), box.last_y));
      const V64 across = hn::Add(product(a, box.last_x), product(b, box.last_y));
      const V64 fall = hn::Sub(across, growth);
      largest = hn::Add(value, hn::ShiftLeft<G::kSubBits>(growth));
      accepted = hn::Not(hn::Lt(hn::Add(value, hn::ShiftLeft<G::kSubBits>(fall)), hn::Zero(D64{})));
      // Where the edge neither accepts nor rejects the box, values are at most their range away from 0.
      is_long = hn::AndNot(accepted, hn::Gt(hn::Sub(growth, fall), hn::Set(D64{}, 0x7FFFFFFF)));
    }
    HWY_INLINE V32 unless_accepted(V64 v) const { return lower(hn::IfThenZeroElse(accepted, v)); }
  };

  static HWY_INLINE void store_edge(V32 x, V32 y, V32 first, std::int32_t carry, EdgeBatch<Value>& out,
                                    int k) {
    const V32 zero = hn::Zero(D32{});
    store(x, out.x + k), store(y, out.y + k), store(first, out.first + k);
    const V32 rise = thrice(hn::Add(hn::Max(x, zero), hn::Max(y, zero)));
    const V32 range = thrice(hn::Add(hn::Abs(x), hn::Abs(y)));
    store(hn::Add(rise, set32(carry)), out.rise + k), store(hn::Add(range, set32(carry)), out.range + k);
  }

  static HWY_NOINLINE void set_up_long(const TriangleLanes64<G>& t, const Area& area,
                                       const BlockBoxLanes& box, LongEdges& out, int k) {
    constexpr int kBits = LongEdges::kLowerBits;
    const V32 lower_bits = set32((1 << kBits) - 1);
    for (int i = 0; i < 3; ++i) {
      const EdgeInBox edge(t, area, i, box);
      const V32 x = edge.unless_accepted(as64(edge.a)), y = edge.unless_accepted(as64(edge.b));
      const V64 value = hn::IfThenZeroElse(edge.accepted, edge.value);
      store_edge(hn::ShiftRight<kBits>(x), hn::ShiftRight<kBits>(y),
                 lower(shift_right<G::kSubBits + kBits>(value)), LongEdges::kMostCarry, out.upper[i], k);
      store(hn::And(x, lower_bits), out.lower[i].x + k), store(hn::And(y, lower_bits), out.lower[i].y + k);
      store(hn::And(lower(shift_right<G::kSubBits>(value)), lower_bits), out.lower[i].first + k);
    }
  }
};

// Sets up the depths of a vector of triangles as entries k … of the batch. Returns the bits of those whose
// planes are exact.
template <class Numbers, class G>
HWY_INLINE std::uint32_t set_up_depth(const TileTask& task, const TriangleLanes64<G>& t, const Area& area,
                                      V32 left, V32 top, const BlockBoxLanes& box, Batch<Numbers>& out,
                                      int k) {
  const V32 zero = hn::Zero(D32{});
  const int in_cell_x = task.x0 % kDepthCell, in_cell_y = task.y0 % kDepthCell;
  const DepthLanes<G> depth = depth_lanes(t, area, task.x0 - in_cell_x, task.y0 - in_cell_y);
  const V32 first = depth.at(hn::Add(left, set32(in_cell_x)), hn::Add(top, set32(in_cell_y)));
  store(depth.x, out.depth.x + k), store(depth.y, out.depth.y + k), store(first, out.depth.first + k);
  store(thrice(hn::Add(hn::Max(depth.x, zero), hn::Max(depth.y, zero))), out.depth_rise + k);

  const auto flat = depth.is_flat();
  const V32 falls_x = hn::Min(depth.x, zero), falls_y = hn::Min(depth.y, zero);
  const V32 in_block = hn::Add(first, thrice(hn::Add(falls_x, falls_y)));
  const V32 in_box =
      hn::Add(first, lower(hn::Add(product(falls_x, box.last_x), product(falls_y, box.last_y))));
  const V32 nearest = nearest_vertex(t);
  store(hn::IfThenElseZero(flat, depth.x), out.nearest.x + k);
  store(hn::IfThenElseZero(flat, depth.y), out.nearest.y + k);
  store(hn::IfThenElse(flat, in_block, nearest), out.nearest.first + k);
  store(hn::IfThenElse(flat, in_box, nearest), out.nearest_in_tile + k);
  return mask_bits(depth.exact);
}

// Sets up a vector of triangles as entries k … of the batch. Returns the bits of those that may cover a pixel
// of the tile.
template <class Numbers>
HWY_INLINE std::uint32_t set_up_vector(const TileTask& task, const std::uint32_t* indices,
                                       Batch<Numbers>& out, int k) {
  using G = typename Numbers::Grid;
  const auto t = load<G>(task.bins.triangles(), indices);
  const Area area = area_of(t);
  const BoxLanes box(t, task.box());
  const auto block = [](V32 px, int first_px) { return hn::ShiftRight<2>(hn::Sub(px, set32(first_px))); };
  const V32 bx0 = block(box.x0, task.x0), bx1 = block(box.x1, task.x0 + 1);  // of pixel box.x1 - 1
  const V32 by0 = block(box.y0, task.y0), by1 = block(box.y1, task.y0 + 1);
  const V32 left = hn::ShiftLeft<2>(bx0), top = hn::ShiftLeft<2>(by0);
  const auto last = [](V32 b0, V32 b1) {
    return hn::Add(hn::ShiftLeft<2>(hn::Sub(b1, b0)), set32(kBlockSide - 1));
  };
  const BlockBoxLanes blocks{sample<G>(left, task.x0), sample<G>(top, task.y0), last(bx0, bx1),
                             last(by0, by1)};
  const std::uint32_t drawn = may_cover(box, area) & Numbers::set_up(task, t, area, blocks, out, k);

  const std::uint32_t exact = set_up_depth(task, t, area, left, top, blocks, out, k);
  store(t.payload, out.payload + k);
  store(lower(shift_right<2 * G::kSubBits>(area.value)), out.twice_area_px2 + k);
  store(bx0, out.bx0 + k), store(by0, out.by0 + k), store(bx1, out.bx1 + k), store(by1, out.by1 + k);
  for (std::uint32_t inexact = drawn & ~exact; inexact != 0; inexact &= inexact - 1) {
    const int lane = std::countr_zero(inexact), at = k + lane;
    const ScreenTriangle& triangle = task.bins.triangles()[indices[lane]];
    const DepthPlane plane = make_depth(orient(triangle));
    const std::uint32_t zx = plane.zx, zy = plane.zy;
    out.depth.x[at] = wrap(zx), out.depth.y[at] = wrap(zy);
    out.depth.first[at] =
        wrap(plane.at(task.x0 + out.bx0[at] * kBlockSide, task.y0 + out.by0[at] * kBlockSide));
    const auto rise = [](std::uint32_t step) { return wrap(step) > 0 ? (kBlockSide - 1) * step : 0; };
    out.depth_rise[at] = wrap(rise(zx) + rise(zy));
    out.nearest.x[at] = out.nearest.y[at] = 0;
    out.nearest.first[at] = out.nearest_in_tile[at] =
        wrap(std::min({triangle.z[0], triangle.z[1], triangle.z[2]}) - kDepthError);
  }
  return drawn;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// The tile kernel is a template on the arithmetic of edge functions. This is the contract's; lab/engine has
// others, to measure what exactness costs.
//
// The contract's edge values are sums of 32 x 32 -> 64 bit products (triangle_lanes-inl.h).
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/edges/tile_linear-inl.h"
#include "raster/kernels.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TILE_ARITHMETIC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_ARITHMETIC_INL_H
#undef EDGEWISE_TILE_ARITHMETIC_INL_H
#else
#define EDGEWISE_TILE_ARITHMETIC_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Edge i of a triangle at a box: a and b of rule 4, the biased value at the box's first sample, and whether
// the edge rejects or accepts the box.
struct EdgeInBox {
  std::int32_t a, b;
  std::int64_t first;
  bool rejects, accepts;

  EdgeInBox(const TileTask& task, const Oriented& t, const BlockBox& box, int i) {
    const Edge edge = make_edge(t, i);
    a = edge.a, b = edge.b;
    first = edge.at(task.x0 + box.left, task.y0 + box.top);
    const std::int64_t across = std::int64_t{a} * kSub * box.last_x,
                       down = std::int64_t{b} * kSub * box.last_y;
    rejects = first + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(down, 0) < 0;
    accepts = first + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(down, 0) >= 0;
  }
};

#if HWY_TARGET != HWY_SCALAR
// The same for half a vector of triangles.
struct EdgeInBoxLanes {
  V32 a, b;
  V64 first, most;        // most: the largest value in the box; if negative, the edge rejects the box
  hn::Mask<D64> crossed;  // where the edge does not accept the box

  HWY_INLINE EdgeInBoxLanes(const TileTask& task, const TriangleLanes& t, const Area& area,
                            const BlockBoxLanes& box, int i) {
    const auto sample = [](V32 px, int origin) {
      return hn::Add(hn::ShiftLeft<kSubBits>(px), set32(sample_sub(origin)));
    };
    const EdgeLanes edge(t, area, i, sample(box.left, task.x0), sample(box.top, task.y0));
    a = edge.a, b = edge.b, first = edge.value;
    const V32 zero = hn::Zero(D32{});
    // rise: the largest edge value less that at the first sample, over 256. across - rise: the same for the
    // least.
    const V64 rise = hn::Add(product(hn::Max(a, zero), box.last_x), product(hn::Max(b, zero), box.last_y));
    most = hn::Add(first, hn::ShiftLeft<kSubBits>(rise));
    const V64 across = hn::Add(product(a, box.last_x), product(b, box.last_y));
    const V64 least = hn::Add(first, hn::ShiftLeft<kSubBits>(hn::Sub(across, rise)));
    crossed = hn::Lt(least, hn::Zero(D64{}));
  }
};
#endif

// The contract's edge functions, shifted (rule 5) in wrapping int32. A pixel is inside where all three are
// >= 0. Other arithmetics have the same members.
struct ContractNumbers : Int32Arithmetic {
  // Whether a value's range over a block, in square pixels, exceeds twice the triangle's area.
  static HWY_INLINE bool spans_more(Value range, std::int32_t twice_area_px) {
    return range >> kSubBits > twice_area_px;
  }

  // Returns false if an edge rejects the box.
  static bool set_up_one(const TileTask& task, const Oriented& t, const BlockBox& box,
                         Linear<Value> (&out)[3], int k) {
    for (int i = 0; i < 3; ++i) {
      const EdgeInBox e(task, t, box, i);
      if (e.rejects) return false;
      e.accepts ? set_linear(out[i], k, 0, 0, 0)
                : set_linear(out[i], k, e.a, e.b, wrap(static_cast<std::uint32_t>(e.first >> kSubBits)));
    }
    return true;
  }

#if HWY_TARGET != HWY_SCALAR
  struct HalfEdges {
    HalfLinear edge[3];
  };
  // The sign bit of a lane is set if an edge rejects the box.
  static HWY_INLINE V64 set_up_half(const TileTask& task, const TriangleLanes& t, const Area& area,
                                    const BlockBoxLanes& box, HalfEdges& out) {
    V64 rejected = hn::Zero(D64{});
    for (int i = 0; i < 3; ++i) {
      const EdgeInBoxLanes e(task, t, area, box, i);
      rejected = hn::Or(rejected, e.most);
      const auto unless_accepted = [&](V64 v) { return lower(hn::IfThenElseZero(e.crossed, v)); };
      out.edge[i] = {unless_accepted(as64(e.a)), unless_accepted(as64(e.b)),
                     unless_accepted(shift_right<kSubBits>(e.first))};
    }
    return rejected;
  }
  // Bit i of the result is 0 if an edge rejects the box of lane i and set_up_half() did not report it.
  static HWY_INLINE std::uint32_t store_edges(const HalfEdges& left, const HalfEdges& right,
                                              Linear<Value> (&out)[3], int k) {
    for (int i = 0; i < 3; ++i) store_linear(left.edge[i], right.edge[i], out[i], k);
    return ~0u;
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

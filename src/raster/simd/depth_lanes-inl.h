// The depth planes of a vector of triangles (rule 6). G is the grid (core/grid.h).
//
// The gradients are divided in doubles and corrected by the remainder, as in contract::gradient(). Lanes
// whose quotient is too large for that are not set in `exact`; the caller recomputes them by the functions of
// contract.h.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_DEPTH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_DEPTH_LANES_INL_H
#undef EDGEWISE_DEPTH_LANES_INL_H
#else
#define EDGEWISE_DEPTH_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Limit of the steps of a depth plane, below which HiZ may use the plane as the bound of nearest depth. Over
// a tile such a plane stays within 2^31 of the triangle's depths, so a wrapped value is negative, which
// counts as near and is conservative. For steeper planes the bound is the nearest vertex.
constexpr std::int32_t kSteep = 1 << 24;

struct Gradient {
  V64 g;                // floor(2^kPlaneBits n / area)
  hn::Mask<D64> exact;  // where g is exact
};
// The double quotient q is within 5 2^-53 |q| < 1/3 of the exact one, and rounding to an integer adds at most
// 1/2. So the floor is that integer or the one below it, depending on the sign of the remainder.
template <class G>
HWY_INLINE Gradient gradient(V64 n, V64 area, hn::Vec<F64> scaled_inverse) {
  const F64 df;
  const D64 d;
  const auto q = hn::Mul(hn::ConvertTo(df, n), scaled_inverse);
  const auto rounder = hn::Set(df, 0x1.8p52);  // one ulp is 1, so adding it rounds to integers
  const V64 g = hn::Sub(hn::BitCast(d, hn::Add(q, rounder)), hn::BitCast(d, rounder));
  const V64 rest = hn::Sub(hn::ShiftLeft<G::kPlaneBits>(n), wrapped_product(g, area));
  return {hn::Sub(g, shift_right<63>(rest)), hn::RebindMask(d, hn::Lt(hn::Abs(q), hn::Set(df, 0x1p49)))};
}

template <class G>
struct DepthLanes {
  V32 x, y;             // steps per pixel
  V64 gx, gy;           // rule 6
  V64 start;            // 2^kPlaneBits (base of the cell + 1/2), before it is rounded down
  hn::Mask<D64> exact;  // where the gradients are exact
  // At pixels of the cell, counted from its first.
  HWY_INLINE V32 at(V32 px, V32 py) const {
    return lower(hn::Add(shift_right<G::kPlaneBits>(start), hn::Add(product(x, px), product(y, py))));
  }
  // Where both steps are below kSteep in size.
  HWY_INLINE hn::Mask<D32> is_flat() const {
    const auto gentle = [](V32 v) { return hn::And(hn::Lt(v, set32(kSteep)), hn::Gt(v, set32(-kSteep))); };
    return hn::And(gentle(x), gentle(y));
  }
};
// A lower bound of the depth of a triangle's pixels.
HWY_INLINE V32 nearest_vertex(const TriangleLanes& t) {
  return hn::Sub(hn::Min(hn::Min(t.z[0], t.z[1]), t.z[2]), set32(contract::kDepthError));
}
// The inputs of a depth plane. dx, dy: from vertex 0 to vertices 1 and 2, in sub-units, with the sign that
// makes the area positive; dz: the same in depth. from_x, from_y: from the anchor (the topmost, then leftmost
// vertex) to the first sample of a depth cell.
struct PlaneLanes {
  V32 dx1, dx2, dy1, dy2, dz1, dz2;
  V64 area;  // twice the area, > 0
  V32 from_x, from_y, anchor_z;
};
template <class G>
HWY_INLINE DepthLanes<G> depth_lanes(const PlaneLanes& p) {
  const D64 d;
  const F64 df;
  const V64 nx = hn::Sub(product(p.dz1, p.dy2), product(p.dz2, p.dy1));
  const V64 ny = hn::Sub(product(p.dz2, p.dx1), product(p.dz1, p.dx2));
  const auto scaled_inverse =
      hn::Div(hn::Set(df, double{std::int64_t{1} << G::kPlaneBits}), hn::ConvertTo(df, p.area));
  const Gradient gx = gradient<G>(nx, p.area, scaled_inverse), gy = gradient<G>(ny, p.area, scaled_inverse);
  // 2^kPlaneBits z, whatever the upper half
  const V64 anchor = shift_right<32 - G::kPlaneBits>(hn::ShiftLeft<32>(as64(p.anchor_z)));
  const V64 round = hn::Set(d, 0x8000), fraction = hn::Set(d, 0xFFFF);
  const V64 rounded_x = hn::Add(gx.g, round), rounded_y = hn::Add(gy.g, round);
  // middle_shift() of contract.h
  constexpr int kHalfCellBits = 5 + G::kSubBits;
  static_assert(contract::kDepthCell / 2 * G::kSub == 1 << kHalfCellBits);
  const V64 shift =
      hn::ShiftLeft<kHalfCellBits>(hn::Add(hn::And(rounded_x, fraction), hn::And(rounded_y, fraction)));
  const V64 half =
      hn::Set(d, (std::int64_t{1} << (G::kPlaneBits - 1)) - (std::int64_t{0x10000} << kHalfCellBits));
  const V64 start = hn::Add(hn::Add(hn::Add(anchor, half), shift),
                            hn::Add(wrapped_product(gx.g, p.from_x), wrapped_product(gy.g, p.from_y)));
  return {lower(shift_right<16>(rounded_x)), lower(shift_right<16>(rounded_y)), gx.g, gy.g, start,
          hn::And(gx.exact, gy.exact)};
}

// The planes over the depth cell whose first pixel is (cell_px, cell_py).
template <class G>
HWY_INLINE DepthLanes<G> depth_lanes(const TriangleLanes64<G>& t, const Area& area, int cell_px,
                                     int cell_py) {
  const AnchorLanes anchor(t.x, t.y, t.z);
  const V32 flip = lower(area.flip);
  const auto turned = [&](V32 to, V32 from) { return flipped(hn::Sub(to, from), flip); };
  return depth_lanes<G>({turned(t.x[1], t.x[0]), turned(t.x[2], t.x[0]), turned(t.y[1], t.y[0]),
                         turned(t.y[2], t.y[0]), hn::Sub(t.z[1], t.z[0]), hn::Sub(t.z[2], t.z[0]), area.value,
                         hn::Sub(set32(G::sample(cell_px)), anchor.x),
                         hn::Sub(set32(G::sample(cell_py)), anchor.y), anchor.z});
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

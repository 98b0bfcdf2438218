// The depth planes of a vector of triangles (rule 6).
//
// The gradient's division is done in doubles and corrected by its remainder, as contract::gradient() does;
// lanes whose quotient is too large for that are told, and the caller does them again by the contract's own
// functions.
#include <hwy/highway.h>

#include <cstdint>

#include "raster/contract.h"
#include "raster/triangle_lanes-inl.h"

// Included once a SIMD target.
#if defined(EDGEWISE_DEPTH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_DEPTH_LANES_INL_H
#undef EDGEWISE_DEPTH_LANES_INL_H
#else
#define EDGEWISE_DEPTH_LANES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// g n mod 2^64, for n >= 0.
HWY_INLINE V64 product(V64 g, V64 n) {
  const hn::Repartition<std::uint32_t, D64> u32;
  const auto gl = hn::BitCast(u32, g), gh = hn::BitCast(u32, upper(g)), nl = hn::BitCast(u32, n),
             nh = hn::BitCast(u32, upper(n));
  const auto cross = hn::Add(hn::MulEven(gl, nh), hn::MulEven(gh, nl));
  return hn::BitCast(D64{}, hn::Add(hn::MulEven(gl, nl), hn::ShiftLeft<32>(cross)));
}

struct Gradient {
  V64 g;                // floor(2^24 n / area)
  hn::Mask<D64> exact;  // where that holds
};
// The double quotient q is within 3 2^-53 |q| < 1/4 of the truth and rounds to an integer within 1/2, so the
// floor is that integer or the one below it; the remainder's sign tells which.
HWY_INLINE Gradient gradient(V64 n, V64 area, hn::Vec<F64> scaled_inverse) {
  const F64 df;
  const D64 d;
  const auto q = hn::Mul(hn::ConvertTo(df, n), scaled_inverse);
  const auto rounder = hn::Set(df, 0x1.8p52);  // its unit is 1: adding it rounds
  const V64 g = hn::Sub(hn::BitCast(d, hn::Add(q, rounder)), hn::BitCast(d, rounder));
  const V64 rest = hn::Sub(hn::ShiftLeft<24>(n), product(g, area));
  return {hn::Sub(g, shift_right<63>(rest)), hn::RebindMask(d, hn::Lt(hn::Abs(q), hn::Set(df, 0x1p49)))};
}

// Twice the signed area, made positive.
struct Area {
  V64 value;
  V64 flip;  // -1 where the winding has been turned round for that
};
HWY_INLINE Area area_of(const TriangleLanes& t) {
  const V64 area = hn::Sub(product(hn::Sub(t.x[1], t.x[0]), hn::Sub(t.y[2], t.y[0])),
                           product(hn::Sub(t.y[1], t.y[0]), hn::Sub(t.x[2], t.x[0])));
  const V64 flip = hn::VecFromMask(D64{}, hn::Lt(area, hn::Zero(D64{})));
  return {flipped(area, flip), flip};
}

struct DepthLanes {
  V32 x, y;             // steps a pixel
  V32 base;             // at the first pixel of the cell
  hn::Mask<D64> exact;  // where all that holds
};
// Over the cell whose first pixel is (cell_px, cell_py).
HWY_INLINE DepthLanes depth_lanes(const TriangleLanes& t, const Area& area, int cell_px, int cell_py) {
  const D64 d;
  const F64 df;
  const V32 dz1 = hn::Sub(t.z[1], t.z[0]), dz2 = hn::Sub(t.z[2], t.z[0]);
  const V32 dx1 = hn::Sub(t.x[1], t.x[0]), dx2 = hn::Sub(t.x[2], t.x[0]);
  const V32 dy1 = hn::Sub(t.y[1], t.y[0]), dy2 = hn::Sub(t.y[2], t.y[0]);
  const V64 nx = flipped(hn::Sub(product(dz1, dy2), product(dz2, dy1)), area.flip);
  const V64 ny = flipped(hn::Sub(product(dz2, dx1), product(dz1, dx2)), area.flip);
  const auto scaled_inverse = hn::Div(hn::Set(df, 0x1p24), hn::ConvertTo(df, area.value));
  const Gradient gx = gradient(nx, area.value, scaled_inverse), gy = gradient(ny, area.value, scaled_inverse);

  // The anchor: the topmost, then leftmost vertex.
  V32 x = t.x[0], y = t.y[0], z = t.z[0];
  for (int i = 1; i < 3; ++i) {
    const auto above = hn::Or(hn::Lt(t.y[i], y), hn::And(hn::Eq(t.y[i], y), hn::Lt(t.x[i], x)));
    x = hn::IfThenElse(above, t.x[i], x);
    y = hn::IfThenElse(above, t.y[i], y);
    z = hn::IfThenElse(above, t.z[i], z);
  }
  const V32 from_x = hn::Sub(set32(contract::sample_sub(cell_px)), x);
  const V32 from_y = hn::Sub(set32(contract::sample_sub(cell_py)), y);
  const V64 anchor = shift_right<8>(hn::ShiftLeft<32>(as64(z)));  // 2^24 z, whatever the upper half
  const V64 half = hn::Set(d, std::int64_t{1} << 23), round = hn::Set(d, 0x8000);
  const V64 base =
      shift_right<24>(hn::Add(hn::Add(anchor, half), hn::Add(product(gx.g, from_x), product(gy.g, from_y))));
  return {lower(shift_right<16>(hn::Add(gx.g, round))), lower(shift_right<16>(hn::Add(gy.g, round))),
          lower(base), hn::And(gx.exact, gy.exact)};
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif

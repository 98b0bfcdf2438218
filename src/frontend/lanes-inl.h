// The steps that the front end's kernels share, in vectors with one vertex or triangle per lane.
//
// Compiled once per SIMD target.
#if defined(EDGEWISE_FRONTEND_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FRONTEND_LANES_INL_H
#undef EDGEWISE_FRONTEND_LANES_INL_H
#else
#define EDGEWISE_FRONTEND_LANES_INL_H
#endif

#include "core/grid.h"
#include "core/lanes-inl.h"
#include "frontend/fixed.h"
#include "frontend/tasks.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE VF real(V words) {
  return hn::BitCast(DF{}, words);
}

// f() of the arguments in double, rounded or truncated to Tag's type.
template <class Tag, typename F, class... Vectors>
HWY_INLINE hn::Vec<Tag> in_double(Tag d, F&& f, Vectors... v) {
#if HWY_TARGET == HWY_SCALAR
  const hn::Rebind<double, Tag> wide;
  return hn::DemoteTo(d, f(hn::PromoteTo(wide, v)...));
#else
  const hn::Half<Tag> half;
  const hn::Rebind<double, hn::Half<Tag> > wide;
  const auto low = f(hn::PromoteTo(wide, hn::LowerHalf(hn::Half<hn::DFromV<Vectors> >{}, v))...);
  const auto high = f(hn::PromoteTo(wide, hn::UpperHalf(hn::Half<hn::DFromV<Vectors> >{}, v))...);
  return hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
#endif
}

// snap(), quantize_depth() and ViewDepth::units() of fixed.h, for vectors.

HWY_INLINE V snap(VF px) {
  const DF d;
  const VF limit = hn::Set(d, static_cast<float>(Coarse::kGuardSub));
  const VF sub = hn::Mul(px, hn::Set(d, static_cast<float>(Coarse::kSub)));
  const VF magic = hn::Set(d, kRoundFloat);
  const VF rounded = hn::Add(hn::Min(hn::Max(sub, hn::Neg(limit)), limit), magic);
  return hn::ShiftLeft<Coarse::kSpareBits>(hn::Sub(hn::BitCast(D{}, rounded), hn::BitCast(D{}, magic)));
}

// units(v…) in double, rounded half to even, above the head-room.
template <typename Units, class... Vectors>
HWY_INLINE V round_depth(Units&& units, Vectors... v) {
  const auto whole_units = [&](auto... wide_v) HWY_ATTR {
    auto exact = units(wide_v...);
    const auto magic = hn::Set(hn::DFromV<decltype(exact)>{}, kRoundDouble);
    return hn::Sub(hn::Add(exact, magic), magic);
  };
  return hn::Add(in_double(D{}, whole_units, v...), hn::Set(D{}, contract::kDepthHead));
}

HWY_INLINE V quantize_depth(VF depth01) {
  const DF d;
  const VF clamped = hn::Min(hn::Max(depth01, hn::Zero(d)), hn::Set(d, 1.0f));
  const auto units = [](auto v) HWY_ATTR {
    return hn::Mul(v, hn::Set(hn::DFromV<decltype(v)>{}, double{contract::kDepthRange}));
  };
  return round_depth(units, clamped);
}

HWY_INLINE V view_depth(const ViewDepth& depth, VF w) {
  const auto units = [&](auto v) HWY_ATTR {
    const hn::DFromV<decltype(v)> d;
    const auto exact = hn::Div(hn::Mul(hn::Sub(v, hn::Set(d, depth.near_z)), hn::Set(d, depth.scale)), v);
    return hn::Min(hn::Max(exact, hn::Zero(d)), hn::Set(d, double{contract::kDepthRange}));
  };
  return round_depth(units, w);
}

// The sign of the area: -1, 0 or 1. Exact in double: with 8 subpixel bits, a product of two differences has
// at most 46 bits that may not be 0.
HWY_INLINE V area_sign(const TriangleLanes& t) {
  const auto sign = [](auto dx1, auto dy1, auto dx2, auto dy2) HWY_ATTR {
    const hn::DFromV<decltype(dx1)> d;
    const auto area = hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dy1, dx2));
    return hn::Min(hn::Max(area, hn::Set(d, -1.0)), hn::Set(d, 1.0));
  };
  return in_double(D{}, sign, hn::Sub(t.x[1], t.x[0]), hn::Sub(t.y[1], t.y[0]), hn::Sub(t.x[2], t.x[0]),
                   hn::Sub(t.y[2], t.y[0]));
}

// The last step of assemble.cpp and stream.cpp. Appends a vector of triangles that need no clipping, in
// order. Drops triangles without area or with the wrong facing, and those that `outside` selects, which lie
// beyond a side of the view. `flags` points to the triangles' flags, or is null.
HWY_INLINE void cull_and_append(const TriangleLanes& t, hn::Mask<D> outside, Cull cull, ChunkOutput& out,
                                const std::uint8_t* flags = nullptr) {
  const D d;
  const V sign = area_sign(t);
  const V front = hn::Set(d, cull == Cull::none || cull == Cull::back ? 1 : 2);
  const V back = hn::Set(d, cull == Cull::none || cull == Cull::front ? -1 : 2);
  hn::Mask<D> faces = hn::Or(hn::Eq(sign, front), hn::Eq(sign, back));
  if (flags != nullptr) {
    const V mark = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, D>{}, flags));
    const hn::Mask<D> two_sided = hn::Ne(hn::And(mark, hn::Set(d, kTwoSided)), hn::Zero(d));
    faces = hn::Or(faces, hn::And(two_sided, hn::Ne(sign, hn::Zero(d))));
  }
  const hn::Mask<D> keep = hn::AndNot(outside, faces);
  const hn::Mask<D> zero = hn::AndNot(outside, hn::Eq(sign, hn::Zero(d)));
  const std::size_t kept = hn::CountTrue(d, keep), flat = hn::CountTrue(d, zero);
  const std::size_t pieces = kLanes - hn::CountTrue(d, outside);
  out.stats.outside += kLanes - pieces;
  out.stats.pieces += pieces;
  out.stats.zero_area += flat;
  out.stats.culled += pieces - flat - kept;
  out.stats.emitted += kept;
  if (kept == 0) return;

  // A dropped lane is stored where the next kept lane goes, which then overwrites it. Highway's Compress()
  // copies a table of 1 KB to the stack on AVX2.
  const std::uint32_t kept_lanes = mask_bits(keep);
  ScreenTriangle* place[kLanes];
  ScreenTriangle* next = out.triangles + out.count;
  for (int lane = 0; lane < kLanes; ++lane) {
    place[lane] = next;
    next += kept_lanes >> lane & 1;
  }
  store_triangles(t, [&](int lane) { return place[lane]; });
  out.count += kept;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

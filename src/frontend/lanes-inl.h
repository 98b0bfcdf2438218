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

// f() of the arguments in double: rounded if Tag's type is float, truncated if it is an integer.
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

// f() of the arguments in double: four words, whole numbers.
template <typename F>
HWY_INLINE Words words_in_double(F&& f, VF x, VF y, VF z) {
#if HWY_TARGET == HWY_SCALAR
  const hn::Rebind<double, D> wide;
  const auto all = f(hn::PromoteTo(wide, x), hn::PromoteTo(wide, y), hn::PromoteTo(wide, z));
  const auto word = [&](std::size_t k) HWY_ATTR { return hn::DemoteTo(D{}, all[k]); };
#else
  const hn::Half<D> half;
  const hn::Half<DF> half_f;
  const hn::Rebind<double, hn::Half<D> > wide;
  const auto low =
      f(hn::PromoteTo(wide, hn::LowerHalf(half_f, x)), hn::PromoteTo(wide, hn::LowerHalf(half_f, y)),
        hn::PromoteTo(wide, hn::LowerHalf(half_f, z)));
  const auto high =
      f(hn::PromoteTo(wide, hn::UpperHalf(half_f, x)), hn::PromoteTo(wide, hn::UpperHalf(half_f, y)),
        hn::PromoteTo(wide, hn::UpperHalf(half_f, z)));
  const auto word = [&](std::size_t k) HWY_ATTR {
    return hn::Combine(D{}, hn::DemoteTo(half, high[k]), hn::DemoteTo(half, low[k]));
  };
#endif
  return {{word(0), word(1), word(2), word(3)}};
}

// snap(), quantize_depth() and ViewDepth::units() of fixed.h, for vectors.

// Scaling is exact, so positions in the guard band are rounded once, for any number of bits. Up to 8 bits,
// one float beyond the band still rounds to its limit.
HWY_INLINE V snap(VF px, int bits) {
#if HWY_TARGET == HWY_SCALAR  // Highway 1.0.3 rounds 0.49999997 up there
  return hn::Set(D{}, edgewise::snap(double{hn::GetLane(px)}, bits));
#else
  const V sub = hn::NearestInt(hn::Mul(px, hn::Set(DF{}, static_cast<float>(1 << bits))));
  return hn::ShiftLeftSame(sub, contract::kFineBits - bits);
#endif
}

// Units above depth 0 → whole ones, half to even.
template <class Doubles>
HWY_INLINE Doubles whole_units(Doubles units) {
  const Doubles magic = hn::Set(hn::DFromV<Doubles>{}, kRoundDouble);
  return hn::Sub(hn::Add(units, magic), magic);
}
template <class Doubles>
HWY_INLINE Doubles within_range(Doubles units) {
  const hn::DFromV<Doubles> d;
  return hn::Min(hn::Max(units, hn::Zero(d)), hn::Set(d, double{contract::kDepthRange}));
}
HWY_INLINE V above_head_room(V units) {
  return hn::Add(units, hn::Set(D{}, contract::kDepthHead));
}

// units(v…) in double, rounded half to even, above the head-room.
template <typename Units, class... Vectors>
HWY_INLINE V round_depth(Units&& units, Vectors... v) {
  return above_head_room(in_double(
      D{}, [&](auto... wide_v) HWY_ATTR { return whole_units(units(wide_v...)); }, v...));
}

// The depths must lie in [0, 1].
HWY_INLINE V quantize_depth(VF depth01) {
  const auto units = [](auto v) HWY_ATTR {
    return hn::Mul(v, hn::Set(hn::DFromV<decltype(v)>{}, double{contract::kDepthRange}));
  };
  return round_depth(units, depth01);
}

HWY_INLINE V view_depth(const ViewDepth& depth, VF w) {
  const auto units = [&](auto v) HWY_ATTR {
    const hn::DFromV<decltype(v)> d;
    return within_range(hn::Div(hn::Mul(hn::Sub(v, hn::Set(d, depth.near_z)), hn::Set(d, depth.scale)), v));
  };
  return round_depth(units, w);
}

// The sign of the area: -1, 0 or 1. A product of two differences has at most 60 bits, of coarse positions 46,
// which are exact in double. Rounded products are in the right order, but may be equal. Then the difference
// is so small that it does not wrap in 32 bits.
HWY_INLINE V area_sign(const TriangleLanes& t, bool fine) {
  const D d;
  const V dx1 = hn::Sub(t.x[1], t.x[0]), dy1 = hn::Sub(t.y[1], t.y[0]), dx2 = hn::Sub(t.x[2], t.x[0]),
          dy2 = hn::Sub(t.y[2], t.y[0]);
  const auto sign = [](auto area) HWY_ATTR {
    const hn::DFromV<decltype(area)> tag;
    return hn::Min(hn::Max(area, hn::Set(tag, -1)), hn::Set(tag, 1));
  };
  const auto difference = [](auto x1, auto y1, auto x2, auto y2)
                              HWY_ATTR { return hn::Sub(hn::Mul(x1, y2), hn::Mul(y1, x2)); };
  const V rounded = in_double(
      d, [&](auto... v) HWY_ATTR { return sign(difference(v...)); }, dx1, dy1, dx2, dy2);
  if (!fine) return rounded;
  return hn::IfThenElse(hn::Eq(rounded, hn::Zero(d)), sign(difference(dx1, dy1, dx2, dy2)), rounded);
}

// The last step of assemble.cpp and stream.cpp. Appends a vector of triangles that need no clipping, in
// order. Drops triangles without area or with the wrong facing, and those that `outside` selects, which lie
// beyond a side of the view. `flags` points to the triangles' flags, or is null.
HWY_INLINE void cull_and_append(const TriangleLanes& t, hn::Mask<D> outside, const FrontendOptions& options,
                                ChunkOutput& out, const std::uint8_t* flags = nullptr) {
  const D d;
  const V sign = area_sign(t, is_fine(options.subpixel_bits));
  const Cull cull = options.cull;
  constexpr int kNoSign = 2;
  const V front = hn::Set(d, cull == Cull::none || cull == Cull::back ? 1 : kNoSign);
  const V back = hn::Set(d, cull == Cull::none || cull == Cull::front ? -1 : kNoSign);
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

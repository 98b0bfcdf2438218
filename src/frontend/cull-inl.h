// The last step of assemble.cpp and stream.cpp: drops triangles without area or with the wrong facing, and
// appends the rest to a chunk's output.
//
// Compiled once per SIMD target, like lanes-inl.h.
#if defined(EDGEWISE_FRONTEND_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FRONTEND_CULL_INL_H
#undef EDGEWISE_FRONTEND_CULL_INL_H
#else
#define EDGEWISE_FRONTEND_CULL_INL_H
#endif

#include <cstring>

#include "core/little_endian.h"
#include "frontend/lanes-inl.h"
#include "frontend/tasks.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

using MI = hn::Mask<DI>;

struct TriangleVectors {
  VI x[3], y[3], z[3], payload;
};

// The sign of the area: -1, 0 or 1. Exact in double: a product of two differences has at most 46 bits.
HWY_INLINE VI area_sign(const TriangleVectors& t) {
  const auto sign = [](auto dx1, auto dy1, auto dx2, auto dy2) HWY_ATTR {
    const hn::DFromV<decltype(dx1)> d;
    const auto area = hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dy1, dx2));
    return hn::Min(hn::Max(area, hn::Set(d, -1.0)), hn::Set(d, 1.0));
  };
  return in_double(DI{}, sign, hn::Sub(t.x[1], t.x[0]), hn::Sub(t.y[1], t.y[0]), hn::Sub(t.x[2], t.x[0]),
                   hn::Sub(t.y[2], t.y[0]));
}

// Appends a vector of triangles that need no clipping, in order. `outside` selects those beyond a side of the
// view, which are dropped. With `kFlagged`, `flags` points to the triangles' flags.
template <bool kFlagged = false>
HWY_INLINE void cull_and_append(const TriangleVectors& t, MI outside, Cull cull, ChunkOutput& out,
                                const std::uint8_t* flags = nullptr) {
  const DI d;
  const VI sign = area_sign(t);
  const VI front = hn::Set(d, cull == Cull::none || cull == Cull::back ? 1 : 2);
  const VI back = hn::Set(d, cull == Cull::none || cull == Cull::front ? -1 : 2);
  MI faces = hn::Or(hn::Eq(sign, front), hn::Eq(sign, back));
  if constexpr (kFlagged) {
    const VI mark = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, DI>{}, flags));
    const MI two_sided = hn::Ne(hn::And(mark, hn::Set(d, kTwoSided)), hn::Zero(d));
    faces = hn::Or(faces, hn::And(two_sided, hn::Ne(sign, hn::Zero(d))));
  }
  const MI keep = hn::AndNot(outside, faces);
  const MI zero = hn::AndNot(outside, hn::Eq(sign, hn::Zero(d)));
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
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, keep, bits);
  std::uint32_t kept_lanes = 0;
  std::memcpy(&kept_lanes, bits, (kLanes + 7) / 8);
  kept_lanes = little_endian(kept_lanes);
  ScreenTriangle* place[kLanes];
  ScreenTriangle* next = out.triangles + out.count;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    place[lane] = next;
    next += kept_lanes >> lane & 1;
  }
  const auto word = [&](std::size_t first) {
    return [&place, first](std::size_t lane) { return reinterpret_cast<std::int32_t*>(place[lane]) + first; };
  };
  store_words({{t.x[0], t.x[1], t.x[2], t.y[0]}}, word(0));
  store_words({{t.y[1], t.y[2], t.z[0], t.z[1]}}, word(4));
  store_words({{t.z[0], t.z[1], t.z[2], t.payload}}, word(6));  // writes words 6 and 7 again: ten in all
  out.count += kept;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

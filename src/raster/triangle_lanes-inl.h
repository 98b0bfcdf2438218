// Triangles in vectors: a 64-bit lane belongs to a triangle. What fits 32 bits (rule 3) lives in the lane's
// lower half, so that one instruction multiplies two of them to a 64-bit product.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "edgewise/screen_triangle.h"

// Included once a SIMD target.
#if defined(EDGEWISE_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TRIANGLE_LANES_INL_H
#undef EDGEWISE_TRIANGLE_LANES_INL_H
#else
#define EDGEWISE_TRIANGLE_LANES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR  // a one-lane target has no halves of lanes

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Names of lanes. I32 vectors have two for each triangle, of which the lower one counts.
using D64 = hn::CappedTag<std::int64_t, 8>;
using U64 = hn::RebindToUnsigned<D64>;
using F64 = hn::RebindToFloat<D64>;
using D32 = hn::Repartition<std::int32_t, D64>;
using Low32 = hn::Rebind<std::uint32_t, D64>;
using V64 = hn::Vec<D64>;
using V32 = hn::Vec<D32>;

HWY_INLINE V32 lower(V64 v) {
  return hn::BitCast(D32{}, v);
}
HWY_INLINE V32 upper(V64 v) {
  return hn::BitCast(D32{}, hn::ShiftRight<32>(hn::BitCast(U64{}, v)));
}
HWY_INLINE V64 as64(V32 v) {
  return hn::BitCast(D64{}, v);
}
template <int kBits>
HWY_INLINE V64 shift_right(V64 v) {
  return hn::BitCast(D64{}, hn::ShiftRight<kBits>(hn::BitCast(U64{}, v)));
}
HWY_INLINE V32 set32(std::int32_t v) {
  return hn::Set(D32{}, v);
}
HWY_INLINE V64 product(V32 a, V32 b) {
  return hn::MulEven(a, b);
}
// g d mod 2^64. With g = low + 2^32 high, low signed: high is g's upper half, rounded.
HWY_INLINE V64 product(V64 g, V32 d) {
  const V32 high = upper(hn::Add(g, hn::Set(D64{}, std::int64_t{1} << 31)));
  return hn::Add(product(lower(g), d), hn::ShiftLeft<32>(product(high, d)));
}
// -v where `flip` is -1, v where it is 0.
HWY_INLINE V32 flipped(V32 v, V32 flip) {
  return hn::Sub(hn::Xor(v, flip), flip);
}
HWY_INLINE V64 flipped(V64 v, V64 flip) {
  return hn::Sub(hn::Xor(v, flip), flip);
}
HWY_INLINE void store(V64 v, std::int32_t* at) {
  const Low32 d;
  hn::StoreU(hn::TruncateTo(d, hn::BitCast(U64{}, v)), d, reinterpret_cast<std::uint32_t*>(at));
}
HWY_INLINE void store(V32 v, std::int32_t* at) {
  store(as64(v), at);
}

// Bit i is lane i's.
HWY_INLINE std::uint32_t mask_bits(hn::Mask<D64> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D64{}, mask, bytes);
  return bytes[0];
}

// Where triangles[index] begins, in bytes.
HWY_INLINE V64 record_offset(V64 index) {
  static_assert(sizeof(ScreenTriangle) == (1 << 5) + (1 << 3));
  return hn::Add(hn::ShiftLeft<5>(index), hn::ShiftLeft<3>(index));
}

struct TriangleLanes {
  V32 x[3], y[3], z[3], payload;
};
// The records at these byte offsets.
HWY_INLINE TriangleLanes load(const ScreenTriangle* triangles, V64 offset) {
  // Five pairs of 32-bit fields, in their order.
  V64 pair[5];
  for (int i = 0; i < 5; ++i)
    pair[i] = hn::GatherOffset(D64{}, reinterpret_cast<const std::int64_t*>(triangles) + i, offset);
  return {{lower(pair[0]), upper(pair[0]), lower(pair[1])},
          {upper(pair[1]), lower(pair[2]), upper(pair[2])},
          {lower(pair[3]), upper(pair[3]), lower(pair[4])},
          upper(pair[4])};
}

// contract::pixel_box() along one axis, relative to `origin` and clipped to [0, end).
struct Range {
  V32 begin, end;
};
HWY_INLINE Range sample_range(const V32 (&c)[3], std::int32_t origin, std::int32_t end) {
  const auto first_sample = [&](V32 v) {
    return hn::Sub(hn::ShiftRight<contract::kSubBits>(hn::Add(v, set32(contract::kHalf - 1))), set32(origin));
  };
  return {hn::Max(first_sample(hn::Min(hn::Min(c[0], c[1]), c[2])), set32(0)),
          hn::Min(first_sample(hn::Max(hn::Max(c[0], c[1]), c[2])), set32(end))};
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif

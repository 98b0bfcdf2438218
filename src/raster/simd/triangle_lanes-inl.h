// Triangles in vectors, one 64-bit lane per triangle. Values that fit 32 bits (rule 3) lie in the lane's
// lower half, so that one instruction multiplies two of them to a 64-bit product. The upper half is
// unspecified unless stated. G is the grid (core/grid.h).
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "edgewise/screen_triangle.h"
#include "raster/simd/rule_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TRIANGLE_LANES_INL_H
#undef EDGEWISE_TRIANGLE_LANES_INL_H
#else
#define EDGEWISE_TRIANGLE_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::CappedTag<std::int64_t, 8>;
using U64 = hn::RebindToUnsigned<D64>;
using F64 = hn::RebindToFloat<D64>;
using D32 = D;  // two lanes per triangle; one for the scalar target
using V64 = hn::Vec<D64>;
using V32 = hn::Vec<D32>;
using Packed = hn::Rebind<std::int32_t, D64>;  // one 32-bit lane per triangle
constexpr int kLanes64 = static_cast<int>(hn::MaxLanes(D64{}));

template <int kBits>
HWY_INLINE V64 shift_right(V64 v) {
  return hn::BitCast(D64{}, hn::ShiftRight<kBits>(hn::BitCast(U64{}, v)));
}
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE V32 lower(V64 v) {
  return hn::Set(D32{}, static_cast<std::int32_t>(hn::GetLane(v)));
}
HWY_INLINE V64 as64(V32 v) {
  return hn::PromoteTo(D64{}, v);
}
HWY_INLINE hn::Vec<Packed> packed(V32 v) {
  return v;
}
#else
HWY_INLINE V32 lower(V64 v) {
  return hn::BitCast(D32{}, v);
}
HWY_INLINE V64 as64(V32 v) {  // the upper half is v's
  return hn::BitCast(D64{}, v);
}
HWY_INLINE hn::Vec<Packed> packed(V32 v) {
  const hn::Rebind<std::uint32_t, D64> d;
  return hn::BitCast(Packed{}, hn::TruncateTo(d, hn::BitCast(U64{}, as64(v))));
}
#endif
HWY_INLINE V32 upper(V64 v) {
  return lower(shift_right<32>(v));
}
HWY_INLINE V32 set32(std::int32_t v) {
  return hn::Set(D32{}, v);
}
// The exact product.
HWY_INLINE V64 product(V32 a, V32 b) {
  return hn::MulEven(a, b);
}
// The product mod 2^64, of any numbers.
HWY_INLINE V64 wrapped_product(V64 a, V64 b) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Mul(a, b);
#else
  const hn::Repartition<std::uint32_t, D64> u32;
  const auto al = hn::BitCast(u32, a), ah = hn::BitCast(u32, upper(a)), bl = hn::BitCast(u32, b),
             bh = hn::BitCast(u32, upper(b));
  const auto cross = hn::Add(hn::MulEven(al, bh), hn::MulEven(ah, bl));
  return hn::BitCast(D64{}, hn::Add(hn::MulEven(al, bl), hn::ShiftLeft<32>(cross)));
#endif
}
// The same with one multiplication less. With a = low + 2^32 high, low signed: high is a's upper half,
// rounded.
HWY_INLINE V64 wrapped_product(V64 a, V32 b) {
  const V32 high = upper(hn::Add(a, hn::Set(D64{}, std::int64_t{1} << 31)));
  return hn::Add(product(lower(a), b), hn::ShiftLeft<32>(product(high, b)));
}
HWY_INLINE V64 flipped(V64 v, V64 flip) {
  return hn::Sub(hn::Xor(v, flip), flip);
}
HWY_INLINE void store(V32 v, std::int32_t* at) {
  hn::StoreU(packed(v), Packed{}, at);
}

// Bit i belongs to lane i. For masks of at most eight lanes.
template <class Tag>
HWY_INLINE std::uint32_t mask_bits(Tag d, hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}
HWY_INLINE std::uint32_t mask_bits(hn::Mask<D64> mask) {
  return mask_bits(D64{}, mask);
}
// Bit i belongs to the lower half of lane i.
HWY_INLINE std::uint32_t lower_bits(hn::Mask<D32> mask) {
  return mask_bits(hn::Lt(hn::ShiftLeft<32>(as64(hn::VecFromMask(D32{}, mask))), hn::Zero(D64{})));
}

// kLanes64 triangles.
template <class G>
struct TriangleLanes64 : GridTriangles<G> {};
// Loads the triangles with these indices, each in both halves of its lane.
template <class G>
HWY_INLINE TriangleLanes64<G> load(const ScreenTriangle* triangles, const std::uint32_t* index) {
  return {GridTriangles<G>(
      load_triangles([&](int lane) { return triangles + index[lane * kLanes64 / kLanes]; }))};
}

// Twice the signed area, made positive.
struct Area {
  V64 value;
  V64 flip;  // -1 where the sign was changed, that is, for the other winding
};
// By the sides from vertex 0 to vertices 1 and 2.
HWY_INLINE Area area_of(V32 dx1, V32 dx2, V32 dy1, V32 dy2) {
  const V64 area = hn::Sub(product(dx1, dy2), product(dy1, dx2));
  const V64 flip = hn::VecFromMask(D64{}, hn::Lt(area, hn::Zero(D64{})));
  return {flipped(area, flip), flip};
}
template <class G>
HWY_INLINE Area area_of(const TriangleLanes64<G>& t) {
  return area_of(hn::Sub(t.x[1], t.x[0]), hn::Sub(t.x[2], t.x[0]), hn::Sub(t.y[1], t.y[0]),
                 hn::Sub(t.y[2], t.y[0]));
}

// Bits of the triangles that have an area, and a box that is not empty.
HWY_INLINE std::uint32_t may_cover(const BoxLanes& box, const Area& area) {
  return lower_bits(box.filled) & mask_bits(hn::Gt(area.value, hn::Zero(D64{})));
}

// Edge i of triangles (rule 4), with its biased value at a sample of each.
struct EdgeLanes {
  V32 a, b;
  V64 value;
  template <class G>
  HWY_INLINE EdgeLanes(const TriangleLanes64<G>& t, const Area& area, int i, V32 sample_x, V32 sample_y) {
    const int j = i == 2 ? 0 : i + 1;
    const V32 flip = lower(area.flip);
    a = flipped(hn::Sub(t.y[i], t.y[j]), flip), b = flipped(hn::Sub(t.x[j], t.x[i]), flip);
    const V64 bias = hn::AndNot(as64(hn::VecFromMask(D32{}, is_top_left(a, b))), hn::Set(D64{}, 1));
    value =
        hn::Sub(hn::Add(product(a, hn::Sub(sample_x, t.x[i])), product(b, hn::Sub(sample_y, t.y[i]))), bias);
  }
};

// Calls set_up(padded, k) for a batch's vectors of triangles, from triangle k on, and collects the returned
// bits of triangles that are drawn. `padded` holds the indices, and then copies of the last one.
template <typename SetUp>
HWY_INLINE std::uint32_t set_up_batch(std::span<const std::uint32_t> indices, SetUp&& set_up) {
  const int count = static_cast<int>(indices.size());
  std::uint32_t padded[kBatch];
  for (int k = 0; k < kBatch; ++k) padded[k] = indices[static_cast<std::size_t>(std::min(k, count - 1))];
  std::uint32_t drawn = 0;
  for (int k = 0; k < count; k += kLanes64) drawn |= set_up(padded, k) << k;
  return drawn & static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

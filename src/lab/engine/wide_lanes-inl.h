// Vectors of kLanes floats, or of 64-bit numbers: two vectors of the target, one for the scalar target. And
// what the policies of this folder share.
#include <hwy/highway.h>

#include <cstdint>

#include "raster/simd/lanes-inl.h"
#include "raster/tiled/tile_numbers-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_WIDE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_WIDE_LANES_INL_H
#undef EDGEWISE_WIDE_LANES_INL_H
#else
#define EDGEWISE_WIDE_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kWideParts = HWY_TARGET == HWY_SCALAR ? 1 : 2;
constexpr int kWidePart = kLanes / kWideParts;  // lanes

template <typename T>
struct WideLanes {
  using Value = T;
  using Part = hn::CappedTag<T, kWidePart>;
  struct Vector {
    hn::Vec<Part> part[kWideParts];
  };
  static HWY_INLINE Vector set(Value v) {
    return each([&](int) { return hn::Set(Part{}, v); });
  }
  static HWY_INLINE Vector load(const Value* at) {
    return each([&](int i) { return hn::Load(Part{}, at + i * kWidePart); });
  }
  static HWY_INLINE void store(const Vector& v, Value* at) {
    for (int i = 0; i < kWideParts; ++i) hn::Store(v.part[i], Part{}, at + i * kWidePart);
  }
  static HWY_INLINE Vector add(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Add(a.part[i], b.part[i]); });
  }
  static HWY_INLINE Vector subtract(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Sub(a.part[i], b.part[i]); });
  }
  template <class Make>
  static HWY_INLINE Vector each(Make&& make) {
    Vector v;
    for (int i = 0; i < kWideParts; ++i) v.part[i] = make(i);
    return v;
  }
  // Part i of 32-bit integers, converted.
  static HWY_INLINE hn::Vec<Part> widened(V v, int i) {
#if HWY_TARGET == HWY_SCALAR
    (void)i;
    return hn::PromoteTo(Part{}, v);
#else
    return hn::PromoteTo(Part{}, i == 0 ? hn::LowerHalf(v) : hn::UpperHalf(hn::Half<D>{}, v));
#endif
  }
};

// A 32-bit lane whose sign bit is that of the 64-bit lane.
HWY_INLINE V sign_words(const WideLanes<std::int64_t>::Vector& v) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(D{}, hn::GetLane(v.part[0]) < 0 ? -1 : 0);
#else
  return hn::ConcatOdd(D{}, hn::BitCast(D{}, v.part[1]), hn::BitCast(D{}, v.part[0]));
#endif
}
// The sign bit is set where one of the three is negative.
HWY_INLINE V any_sign(V a, V b, V c) {
  return hn::Or(hn::Or(a, b), c);
}
HWY_INLINE V any_sign(const WideLanes<std::int64_t>::Vector& a, const WideLanes<std::int64_t>::Vector& b,
                      const WideLanes<std::int64_t>::Vector& c) {
  return sign_words(
      WideLanes<std::int64_t>::each([&](int i) { return hn::Or(hn::Or(a.part[i], b.part[i]), c.part[i]); }));
}

struct FloatLanes {
  using Value = float;
  using Floats = hn::RebindToFloat<D>;
  using Vector = hn::Vec<Floats>;
  using Bits = Int32Lanes;
  static HWY_INLINE Vector set(Value v) { return hn::Set(Floats{}, v); }
  static HWY_INLINE Vector load(const Value* at) { return hn::Load(Floats{}, at); }
  static HWY_INLINE void store(Vector v, Value* at) { hn::Store(v, Floats{}, at); }
  static HWY_INLINE Vector add(Vector a, Vector b) { return hn::Add(a, b); }
  static HWY_INLINE Vector subtract(Vector a, Vector b) { return hn::Sub(a, b); }
  static HWY_INLINE Vector times(V count, Value step) {
    return hn::Mul(hn::ConvertTo(Floats{}, count), hn::Set(Floats{}, step));
  }
  static HWY_INLINE Vector four_times(Vector v) { return hn::Mul(v, hn::Set(Floats{}, 4.0f)); }
  static HWY_INLINE V bits(Vector v) { return hn::BitCast(D{}, v); }
};

// Stores linear functions, from f.x[k] on. Steps are in units of the values.
template <class Tag, typename Value>
HWY_INLINE void store_functions(Tag d, hn::Vec<Tag> x, hn::Vec<Tag> y, hn::Vec<Tag> first, Linear<Value>& f,
                                int k) {
  const auto zero = hn::Zero(d), three = hn::Set(d, Value{kBlockSide - 1});
  const auto rise = hn::Mul(three, hn::Add(hn::Max(x, zero), hn::Max(y, zero)));
  hn::StoreU(x, d, f.x + k), hn::StoreU(y, d, f.y + k), hn::StoreU(first, d, f.first + k);
  hn::StoreU(rise, d, f.rise + k), hn::StoreU(hn::Add(first, rise), d, f.most + k);
  hn::StoreU(hn::Mul(three, hn::Add(hn::Abs(x), hn::Abs(y))), d, f.span + k);
}

#if HWY_TARGET != HWY_SCALAR
// The inputs of a policy's set-up for half a vector of triangles, in its own units or as bits of floats.
struct HalfPositions {
  V32 x[3], y[3];
  BlockBoxLanes box;
};
#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

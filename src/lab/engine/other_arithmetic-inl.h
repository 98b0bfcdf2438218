// Edge functions of the snapped vertices in other arithmetic than the contract's:
//   E(s) = (a s.x + b s.y) - (a p.x + b p.y) - bias,  a = p.y - q.y,  b = q.x - p.x
// in sub-units. E is evaluated at the box's first sample and stepped from there. The origin is the frame's
// corner, as in programs that keep three coefficients per edge (Olano and Greer, "Triangle scan conversion
// using 2D homogeneous coordinates", 1997), or the tile's corner. Orientation, boxes and depths are the
// contract's.
//
// int64 and double hold every value exactly: by rule 3, sums of products stay below 2^50. int32 wraps. In
// float, a, b and coordinates are exact; products and sums are rounded.
//
// No E is -0, so the sign bit of a float tells whether it is negative. A sum is -0 only if both terms are.
// a s.x and b s.y are not both -0, since no sample has a coordinate 0 and a or b is not 0.
#include <hwy/highway.h>

#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/grid.h"
#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/edges/tile_setup-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_OTHER_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_OTHER_NUMBERS_INL_H
#undef EDGEWISE_OTHER_NUMBERS_INL_H
#else
#define EDGEWISE_OTHER_NUMBERS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// a b, for 64-bit integers only if a and b fit 32 bits: few targets multiply more at once.
template <class DF>
HWY_INLINE hn::Vec<DF> product_of(DF df, hn::Vec<DF> a, hn::Vec<DF> b) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (std::is_same_v<hn::TFromD<DF>, std::int64_t>) {
    const hn::Repartition<std::int32_t, DF> halves;
    return hn::MulEven(hn::BitCast(halves, a), hn::BitCast(halves, b));
  }
#endif
  (void)df;
  return hn::Mul(a, b);
}

struct FloatNumbers {
  using Value = float;
  using Floats = hn::RebindToFloat<D>;
  using Vector = hn::Vec<Floats>;
  static HWY_INLINE Vector set(Value v) { return hn::Set(Floats{}, v); }
  static HWY_INLINE Vector load_values(const Value* at) { return hn::Load(Floats{}, at); }
  static HWY_INLINE void store_values(Vector v, Value* at) { hn::Store(v, Floats{}, at); }
  static HWY_INLINE Vector add(Vector a, Vector b) { return hn::Add(a, b); }
  static HWY_INLINE Vector subtract(Vector a, Vector b) { return hn::Sub(a, b); }
  static HWY_INLINE Vector times(V pixels, Value step) {
    return hn::Mul(hn::ConvertTo(Floats{}, pixels), hn::Set(Floats{}, step));
  }
  static HWY_INLINE Vector four_times(Vector v) { return hn::Mul(v, hn::Set(Floats{}, 4.0f)); }
  static HWY_INLINE V any_negative(Vector e0, Vector e1, Vector e2) {
    return hn::BitCast(D{}, hn::Or(hn::Or(e0, e1), e2));
  }
};

constexpr int kHalves = HWY_TARGET == HWY_SCALAR ? 1 : 2;
constexpr int kHalfLanes = kLanes / kHalves;  // lanes

// Vectors of kLanes 64-bit numbers: two vectors of the target, one for the scalar target.
template <typename T>
struct WideNumbers {
  using Value = T;
  using Half = hn::CappedTag<T, kHalfLanes>;
  struct Vector {
    hn::Vec<Half> half[kHalves];
  };
  static HWY_INLINE Vector set(Value v) {
    return each([&](int) { return hn::Set(Half{}, v); });
  }
  static HWY_INLINE Vector load_values(const Value* at) {
    return each([&](int i) { return hn::Load(Half{}, at + i * kHalfLanes); });
  }
  static HWY_INLINE void store_values(const Vector& v, Value* at) {
    for (int i = 0; i < kHalves; ++i) hn::Store(v.half[i], Half{}, at + i * kHalfLanes);
  }
  static HWY_INLINE Vector add(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Add(a.half[i], b.half[i]); });
  }
  static HWY_INLINE Vector subtract(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Sub(a.half[i], b.half[i]); });
  }
  static HWY_INLINE Vector times(V pixels, Value step) {
    if constexpr (std::is_integral_v<T>) pixels = hn::ShiftLeft<Coarse::kSubBits>(pixels);
    return each([&](int i) { return product_of(Half{}, widened(pixels, i), hn::Set(Half{}, step)); });
  }
  static HWY_INLINE Vector four_times(const Vector& v) {
    return each([&](int i) {
      if constexpr (std::is_integral_v<T>)
        return hn::ShiftLeft<2>(v.half[i]);
      else
        return hn::Mul(v.half[i], hn::Set(Half{}, T{4}));
    });
  }
  static HWY_INLINE V any_negative(const Vector& e0, const Vector& e1, const Vector& e2) {
    const auto any = [&](int i) { return hn::Or(hn::Or(e0.half[i], e1.half[i]), e2.half[i]); };
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(D{}, hn::GetLane(hn::BitCast(hn::CappedTag<std::int64_t, 1>{}, any(0))) < 0 ? -1 : 0);
#else
    return hn::ConcatOdd(D{}, hn::BitCast(D{}, any(1)), hn::BitCast(D{}, any(0)));
#endif
  }

 private:
  template <class Make>
  static HWY_INLINE Vector each(Make&& make) {
    Vector v;
    for (int i = 0; i < kHalves; ++i) v.half[i] = make(i);
    return v;
  }
  static HWY_INLINE hn::Vec<Half> widened(V v, int i) {
#if HWY_TARGET == HWY_SCALAR
    (void)i;
    return hn::PromoteTo(Half{}, v);
#else
    return hn::PromoteTo(Half{}, i == 0 ? hn::LowerHalf(v) : hn::UpperHalf(hn::Half<D>{}, v));
#endif
  }
};

// The kernel's numbers (tile_setup-inl.h). Rebased: relative to the tile's corner.
template <class Numbers, bool kRebased = false>
struct OtherNumbers : Numbers {
  using typename Numbers::Value;
  using Grid = Coarse;
  static constexpr bool kHasLongEdges = false;

  static HWY_INLINE bool exceeds(Value range, std::int32_t twice_area_px2) {
    // The area was rounded down.
    return static_cast<double>(range) >= (twice_area_px2 + 1.0) * (1 << 2 * Coarse::kSubBits);
  }

  // As in ContractNumbers.
  static HWY_INLINE std::uint32_t set_up(const TileTask& task, const TriangleLanes64<Grid>& t,
                                         const Area& area, const BlockBoxLanes& box, Batch<OtherNumbers>& out,
                                         int k) {
    const V32 flip = lower(area.flip);
    const V32 x0 = set32(kRebased ? task.x0 * Coarse::kSub : 0),
              y0 = set32(kRebased ? task.y0 * Coarse::kSub : 0);
    std::uint32_t kept = ~0u;
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      kept &= set_up_edge({flipped(hn::Sub(t.y[i], t.y[j]), flip), flipped(hn::Sub(t.x[j], t.x[i]), flip),
                           hn::Sub(t.x[i], x0), hn::Sub(t.y[i], y0), hn::Sub(box.sample_x, x0),
                           hn::Sub(box.sample_y, y0), box.last_x, box.last_y},
                          out.edge[i], k);
    }
    return kept;
  }

 private:
  using Tag = hn::Rebind<Value, D64>;  // one triangle per lane
  using Vec = hn::Vec<Tag>;
  struct EdgeInput {
    V32 a, b, x, y;  // of an edge that begins at (x, y)
    V32 sample_x, sample_y, last_x, last_y;
  };

  static HWY_INLINE Vec number(V32 v) {
    if constexpr (std::is_same_v<Value, std::int32_t>)
      return packed(v);
    else if constexpr (std::is_same_v<Value, float>)
      return hn::ConvertTo(Tag{}, packed(v));
    else
      return hn::PromoteTo(Tag{}, packed(v));
  }
  static HWY_INLINE Vec in_px(Vec v) {
    if constexpr (std::is_integral_v<Value>)
      return hn::ShiftLeft<Coarse::kSubBits>(v);
    else
      return hn::Mul(v, hn::Set(Tag{}, Value{Coarse::kSub}));
  }
  // Steps of 64-bit integers fit 32 bits: times() counts their units.
  static HWY_INLINE Vec step(Vec v) {
    if constexpr (std::is_same_v<Value, std::int64_t>)
      return v;
    else
      return in_px(v);
  }
  static HWY_INLINE Vec weighted(Vec p, Vec q, Vec x, Vec y) {
    return hn::Add(product_of(Tag{}, p, x), product_of(Tag{}, q, y));
  }
  // That of rule 4. In floats it is more than is lost by rounding `first` and values up to a block's range,
  // so that a sample exactly on the edge stays outside.
  static HWY_INLINE Vec bias_of(Vec first, Vec range) {
    const auto one = hn::Set(Tag{}, Value{1});
    if constexpr (std::is_integral_v<Value>)
      return one;
    else
      return hn::Max(one, hn::Mul(hn::Add(hn::Abs(first), range),
                                  hn::Set(Tag{}, std::numeric_limits<Value>::epsilon())));
  }

  static HWY_INLINE std::uint32_t set_up_edge(const EdgeInput& in, EdgeBatch<Value>& out, int k) {
    const Tag d;
    const Vec zero = hn::Zero(d), a = number(in.a), b = number(in.b);
    const Vec last_x = number(in.last_x), last_y = number(in.last_y);
    const Vec up_x = hn::Max(a, zero), up_y = hn::Max(b, zero);
    const Vec down_x = hn::Min(a, zero), down_y = hn::Min(b, zero);
    const auto over_block = [](Vec v) { return in_px(hn::Add(v, hn::Add(v, v))); };
    const Vec rise = over_block(hn::Add(up_x, up_y)), fall = over_block(hn::Add(down_x, down_y));
    const Vec range = hn::Sub(rise, fall);
    const Vec unbiased = hn::Sub(weighted(a, b, number(in.sample_x), number(in.sample_y)),
                                 weighted(a, b, number(in.x), number(in.y)));
    const Vec first = hn::Sub(unbiased, hn::IfThenZeroElse(is_top_left(a, b), bias_of(unbiased, range)));
    const Vec largest_in_box = hn::Add(first, in_px(weighted(up_x, up_y, last_x, last_y)));
    const Vec smallest_in_box = hn::Add(first, in_px(weighted(down_x, down_y, last_x, last_y)));
    const auto keep = [&](Vec v, Value* list) {  // 0 where the edge accepts the box
      hn::StoreU(hn::IfThenElseZero(hn::Lt(smallest_in_box, zero), v), d, list + k);
    };
    keep(step(a), out.x), keep(step(b), out.y), keep(first, out.first);
    keep(rise, out.rise), keep(range, out.range);
    return ~mask_bits(d, hn::Lt(largest_in_box, zero));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

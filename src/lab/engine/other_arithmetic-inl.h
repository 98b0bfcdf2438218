// Edge functions of the snapped vertices in other arithmetic than the contract's:
//   E(s) = (a s.x + b s.y) - (a p.x + b p.y) - bias,  a = p.y - q.y,  b = q.x - p.x
// in sub-units. E is evaluated at the box's first sample and stepped from there. The origin is the frame's
// corner, as in programs that keep three coefficients per edge (Olano and Greer, "Triangle scan conversion
// using 2D homogeneous coordinates", 1997), or the tile's corner. Orientation, boxes and depths are the
// contract's.
//
// int64 and double hold every value exactly: by rule 3, sums of products stay below 2^50. int64 counts in
// 1/4096 px, so that it costs what 12 subpixel bits would; then sums stay below 2^58. int32 wraps. In float,
// a, b and coordinates are exact; products and sums are rounded.
//
// No E is -0, so the sign bit of a float tells whether it is negative. A sum is -0 only if both terms are.
// a s.x and b s.y are not both -0, since no sample has a coordinate 0 and a or b is not 0.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/edges/tile_arithmetic-inl.h"

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

// Bits below those of a sub-unit.
template <typename T>
constexpr int kFinerBits = std::is_same_v<T, std::int64_t> ? 12 - contract::kSubBits : 0;

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

struct FloatLanes {
  using Value = float;
  using Floats = hn::RebindToFloat<D>;
  using Vector = hn::Vec<Floats>;
  static HWY_INLINE Vector set(Value v) { return hn::Set(Floats{}, v); }
  static HWY_INLINE Vector load(const Value* at) { return hn::Load(Floats{}, at); }
  static HWY_INLINE void store(Vector v, Value* at) { hn::Store(v, Floats{}, at); }
  static HWY_INLINE Vector add(Vector a, Vector b) { return hn::Add(a, b); }
  static HWY_INLINE Vector subtract(Vector a, Vector b) { return hn::Sub(a, b); }
  static HWY_INLINE Vector times(V count, Value step) {
    return hn::Mul(hn::ConvertTo(Floats{}, count), hn::Set(Floats{}, step));
  }
  static HWY_INLINE Vector four_times(Vector v) { return hn::Mul(v, hn::Set(Floats{}, 4.0f)); }
  static HWY_INLINE V outside(Vector e0, Vector e1, Vector e2) {
    return hn::BitCast(D{}, hn::Or(hn::Or(e0, e1), e2));
  }
};

constexpr int kHalves = HWY_TARGET == HWY_SCALAR ? 1 : 2;
constexpr int kHalfLanes = kLanes / kHalves;  // lanes

// Vectors of kLanes 64-bit numbers: two vectors of the target, one for the scalar target.
template <typename T>
struct WideLanes {
  using Value = T;
  using Half = hn::CappedTag<T, kHalfLanes>;
  struct Vector {
    hn::Vec<Half> half[kHalves];
  };
  static HWY_INLINE Vector set(Value v) {
    return each([&](int) { return hn::Set(Half{}, v); });
  }
  static HWY_INLINE Vector load(const Value* at) {
    return each([&](int i) { return hn::Load(Half{}, at + i * kHalfLanes); });
  }
  static HWY_INLINE void store(const Vector& v, Value* at) {
    for (int i = 0; i < kHalves; ++i) hn::Store(v.half[i], Half{}, at + i * kHalfLanes);
  }
  static HWY_INLINE Vector add(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Add(a.half[i], b.half[i]); });
  }
  static HWY_INLINE Vector subtract(const Vector& a, const Vector& b) {
    return each([&](int i) { return hn::Sub(a.half[i], b.half[i]); });
  }
  static HWY_INLINE Vector times(V count, Value step) {
    if constexpr (std::is_integral_v<T>) count = hn::ShiftLeft<contract::kSubBits + kFinerBits<T>>(count);
    return each([&](int i) { return product_of(Half{}, widened(count, i), hn::Set(Half{}, step)); });
  }
  static HWY_INLINE Vector four_times(const Vector& v) {
    return each([&](int i) {
      if constexpr (std::is_integral_v<T>)
        return hn::ShiftLeft<2>(v.half[i]);
      else
        return hn::Mul(v.half[i], hn::Set(Half{}, T{4}));
    });
  }
  static HWY_INLINE V outside(const Vector& e0, const Vector& e1, const Vector& e2) {
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

template <class Lanes, bool kRebased = false>
struct OtherArithmetic : Lanes {
  using typename Lanes::Value;
  using typename Lanes::Vector;
  // Of an edge: a, b, p.x, p.y, the box's first sample, and its last pixel from its first.
  static constexpr int kInputs = 8;
  static constexpr std::int32_t origin(int tile_px) { return kRebased ? tile_px * contract::kSub : 0; }

  static HWY_INLINE bool spans_more(Value range, std::int32_t twice_area_px) {
    // The area was rounded down.
    return static_cast<double>(range) >=
           (twice_area_px + 1.0) * (1 << 2 * (contract::kSubBits + kFinerBits<Value>));
  }

  static bool set_up_one(const TileTask& task, const contract::Oriented& t, const BlockBox& box,
                         Linear<Value> (&out)[3], int k) {
    const hn::CappedTag<Value, 1> df;
    const auto set = [&](std::int32_t v) { return hn::Set(df, static_cast<Value>(v)); };
    for (int i = 0; i < 3; ++i) {
      const contract::Edge e = contract::make_edge(t, i);
      const hn::Vec<decltype(df)> in[kInputs] = {
          set(e.a),
          set(e.b),
          set(t.x[i] - origin(task.x0)),
          set(t.y[i] - origin(task.y0)),
          set(contract::sample_sub(task.x0 + box.left) - origin(task.x0)),
          set(contract::sample_sub(task.y0 + box.top) - origin(task.y0)),
          set(box.last_x),
          set(box.last_y)};
      if (!hn::AllFalse(df, set_up_edge(df, in, out[i], k))) return false;
    }
    return true;
  }

#if HWY_TARGET != HWY_SCALAR
  struct HalfEdges {
    V32 edge[3][kInputs];
  };
  static HWY_INLINE V64 set_up_half(const TileTask& task, const TriangleLanes& t, const Area& area,
                                    const BlockBoxLanes& box, HalfEdges& out) {
    const V32 flip = lower(area.flip), x0 = set32(origin(task.x0)), y0 = set32(origin(task.y0));
    const auto sample = [](V32 px, int first) {
      return hn::Add(hn::ShiftLeft<contract::kSubBits>(px), set32(contract::sample_sub(first)));
    };
    const V32 sample_x = hn::Sub(sample(box.left, task.x0), x0),
              sample_y = hn::Sub(sample(box.top, task.y0), y0);
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const V32 in[kInputs] = {flipped(hn::Sub(t.y[i], t.y[j]), flip),
                               flipped(hn::Sub(t.x[j], t.x[i]), flip),
                               hn::Sub(t.x[i], x0),
                               hn::Sub(t.y[i], y0),
                               sample_x,
                               sample_y,
                               box.last_x,
                               box.last_y};
      std::copy(in, in + kInputs, out.edge[i]);
    }
    return hn::Zero(D64{});
  }
  static HWY_INLINE std::uint32_t store_edges(const HalfEdges& left, const HalfEdges& right,
                                              Linear<Value> (&out)[3], int k) {
    std::uint32_t rejected = 0;
    for (int i = 0; i < 3; ++i)
      if constexpr (sizeof(Value) == sizeof(std::int32_t)) {
        const hn::Rebind<Value, D> df;
        hn::Vec<decltype(df)> in[kInputs];
        for (int n = 0; n < kInputs; ++n) {
          const V whole = both(left.edge[i][n], right.edge[i][n]);
          if constexpr (std::is_integral_v<Value>)
            in[n] = whole;
          else
            in[n] = hn::ConvertTo(df, whole);
        }
        rejected |= mask_bits(hn::RebindMask(D{}, set_up_edge(df, in, out[i], k)));
      } else {
        rejected |= store_half(left.edge[i], out[i], k) | store_half(right.edge[i], out[i], k + kHalfLanes)
                                                              << kHalfLanes;
      }
    return ~rejected;
  }
#endif

 private:
  // That of rule 4. In floats it is more than is lost by rounding `first` and values up to a block's range,
  // so that a sample exactly on the edge stays outside.
  template <class DF>
  static HWY_INLINE hn::Vec<DF> bias_of(DF df, hn::Vec<DF> first, hn::Vec<DF> range) {
    const auto one = hn::Set(df, Value{1});
    if constexpr (std::is_integral_v<Value>)
      return one;
    else
      return hn::Max(
          one, hn::Mul(hn::Add(hn::Abs(first), range), hn::Set(df, std::numeric_limits<Value>::epsilon())));
  }

#if HWY_TARGET != HWY_SCALAR
  static HWY_INLINE std::uint32_t store_half(const V32 (&edge)[kInputs], Linear<Value>& out, int k) {
    const hn::Rebind<Value, D64> df;
    const hn::Rebind<std::int32_t, D64> packed;
    hn::Vec<decltype(df)> in[kInputs];
    for (int n = 0; n < kInputs; ++n)
      in[n] =
          hn::PromoteTo(df, hn::BitCast(packed, hn::TruncateTo(Low32{}, hn::BitCast(U64{}, as64(edge[n])))));
    return mask_bits(hn::RebindMask(D64{}, set_up_edge(df, in, out, k)));
  }
#endif

  // Stores the edge from out.x[k] on. An edge that accepts the box becomes the constant 0. The mask is set
  // where the edge rejects the box.
  template <class DF>
  static HWY_INLINE hn::Mask<DF> set_up_edge(DF df, const hn::Vec<DF> (&in)[kInputs], Linear<Value>& out,
                                             int k) {
    const auto finer = [&](int i) {
      if constexpr (kFinerBits<Value> == 0)
        return in[i];
      else
        return hn::ShiftLeft<kFinerBits<Value>>(in[i]);
    };
    const auto a = finer(0), b = finer(1), x = finer(2), y = finer(3), sample_x = finer(4),
               sample_y = finer(5), last_x = in[6], last_y = in[7];
    const auto weighted = [&](auto p, auto q, auto x_of, auto y_of) {
      return hn::Add(product_of(df, p, x_of), product_of(df, q, y_of));
    };
    const auto in_px = [&](auto v) {
      if constexpr (std::is_integral_v<Value>)
        return hn::ShiftLeft<contract::kSubBits + kFinerBits<Value>>(v);
      else
        return hn::Mul(v, hn::Set(df, Value{contract::kSub}));
    };
    const auto over_block = [&](auto v) { return in_px(hn::Add(v, hn::Add(v, v))); };
    const auto zero = hn::Zero(df);
    const auto top_left = is_top_left(a, b);
    const auto up_x = hn::Max(a, zero), up_y = hn::Max(b, zero);
    const auto down_x = hn::Min(a, zero), down_y = hn::Min(b, zero);
    const auto rise = over_block(hn::Add(up_x, up_y)), fall = over_block(hn::Add(down_x, down_y));
    const auto range = hn::Sub(rise, fall);
    const auto unbiased = hn::Sub(weighted(a, b, sample_x, sample_y), weighted(a, b, x, y));
    const auto first = hn::Sub(unbiased, hn::IfThenZeroElse(top_left, bias_of(df, unbiased, range)));
    const auto most = hn::Add(first, in_px(weighted(up_x, up_y, last_x, last_y)));
    const auto least = hn::Add(first, in_px(weighted(down_x, down_y, last_x, last_y)));
    const auto crossed = hn::Lt(least, zero);
    const auto kept = [&](auto v) { return hn::IfThenElseZero(crossed, v); };
    // Steps of 64-bit integers fit 32 bits: times() counts their units.
    const auto step = [&](auto v) {
      if constexpr (std::is_same_v<Value, std::int64_t>)
        return v;
      else
        return in_px(v);
    };
    hn::StoreU(kept(step(a)), df, out.x + k), hn::StoreU(kept(step(b)), df, out.y + k);
    hn::StoreU(kept(first), df, out.first + k), hn::StoreU(kept(hn::Add(first, rise)), df, out.most + k);
    hn::StoreU(kept(rise), df, out.rise + k), hn::StoreU(kept(range), df, out.range + k);
    return hn::Lt(most, zero);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

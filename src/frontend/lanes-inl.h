// Vectors of the front end's kernels, with one vertex or triangle per lane. 4 x 4 transpositions convert
// between records in memory and vectors: one memory access per record, where gathers need one per number.
//
// Compiled once per SIMD target. Include it after hwy/highway.h, in a file that uses foreach_target.h.
#if defined(EDGEWISE_FRONTEND_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FRONTEND_LANES_INL_H
#undef EDGEWISE_FRONTEND_LANES_INL_H
#else
#define EDGEWISE_FRONTEND_LANES_INL_H
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "frontend/fixed.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, 16>;
using DF = hn::Rebind<float, DI>;
using VI = hn::Vec<DI>;
using VF = hn::Vec<DF>;
// Triangles or vertices that are processed together.
constexpr std::size_t kLanes = hn::MaxLanes(DI{});

// first, first + 1, … core/lanes-inl.h says why this is not Iota(first).
HWY_INLINE VI counting_from(std::size_t first) {
  return hn::Add(hn::Iota(DI{}, 0), hn::Set(DI{}, static_cast<std::int32_t>(first)));
}

// Four words of each lane's record: word[k] holds word k of all lanes.
struct Words {
  VI word[4];
};

#if HWY_TARGET == HWY_SCALAR

template <typename At>
HWY_INLINE Words load_words(At&& at) {
  const DI d;
  std::int32_t word[4];
  std::memcpy(word, at(0), sizeof word);  // they may be floats
  return {{hn::Set(d, word[0]), hn::Set(d, word[1]), hn::Set(d, word[2]), hn::Set(d, word[3])}};
}

template <typename At>
HWY_INLINE void store_words(const Words& w, At&& at) {
  for (int k = 0; k < 4; ++k) hn::StoreU(w.word[k], DI{}, at(0) + k);
}

// f() of the arguments in double, rounded or truncated to D's type.
template <class D, typename F, class... V>
HWY_INLINE hn::Vec<D> in_double(D d, F&& f, V... v) {
  const hn::Rebind<double, D> wide;
  return hn::DemoteTo(d, f(hn::PromoteTo(wide, v)...));
}

#else

// Loads the records of lanes 0, 4, 8, …, four words each, into consecutive blocks of four lanes.
template <class D, typename At>
HWY_INLINE hn::Vec<D> load_blocks(D d, At&& at) {
  if constexpr (hn::MaxLanes(D{}) == 4) {
    return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(at(0)));
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kUpper = hn::MaxLanes(D{}) / 2;
    return hn::Combine(d, load_blocks(half, [&](std::size_t lane) { return at(lane + kUpper); }),
                       load_blocks(half, at));
  }
}

HWY_INLINE Words transpose(const Words& w) {
  const DI d;
  const hn::Repartition<std::int64_t, DI> pairs;
  const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, w.word[0], w.word[1]));
  const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, w.word[2], w.word[3]));
  const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, w.word[0], w.word[1]));
  const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, w.word[2], w.word[3]));
  return {{hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)),
           hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23))}};
}

// at(lane) points to the four words of a lane, of any 32-bit type.
template <typename At>
HWY_INLINE Words load_words(At&& at) {
  const DI d;
  const auto every_fourth = [&](std::size_t first) {
    return load_blocks(d, [&](std::size_t lane) { return at(lane + first); });
  };
  return transpose({{every_fourth(0), every_fourth(1), every_fourth(2), every_fourth(3)}});
}

template <class V, typename At>
HWY_INLINE void store_records(V first, V second, V third, V fourth, At&& at) {
  using D = hn::DFromV<V>;
  if constexpr (hn::MaxLanes(D{}) == 4) {
    hn::StoreU(first, D{}, at(0));
    hn::StoreU(second, D{}, at(1));
    hn::StoreU(third, D{}, at(2));
    hn::StoreU(fourth, D{}, at(3));
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kUpper = hn::MaxLanes(D{}) / 2;
    store_records(hn::LowerHalf(half, first), hn::LowerHalf(half, second), hn::LowerHalf(half, third),
                  hn::LowerHalf(half, fourth), at);
    store_records(hn::UpperHalf(half, first), hn::UpperHalf(half, second), hn::UpperHalf(half, third),
                  hn::UpperHalf(half, fourth), [&](std::size_t lane) { return at(lane + kUpper); });
  }
}

// Stores in the order of the lanes: if two lanes have the same address, the later one stays.
template <typename At>
HWY_INLINE void store_words(const Words& words, At&& at) {
  const Words records = transpose(words);
  store_records(records.word[0], records.word[1], records.word[2], records.word[3], at);
}

// f() of the arguments in double, rounded or truncated to D's type.
template <class D, typename F, class... V>
HWY_INLINE hn::Vec<D> in_double(D d, F&& f, V... v) {
  const hn::Half<D> half;
  const hn::Rebind<double, hn::Half<D> > wide;
  const auto low = f(hn::PromoteTo(wide, hn::LowerHalf(hn::Half<hn::DFromV<V> >{}, v))...);
  const auto high = f(hn::PromoteTo(wide, hn::UpperHalf(hn::Half<hn::DFromV<V> >{}, v))...);
  return hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

#endif

// snap(), quantize_depth() and ViewDepth::units() of fixed.h, for vectors.

HWY_INLINE VI snap(VF px) {
  const DF d;
  const VF limit = hn::Set(d, static_cast<float>(contract::kGuardSub));
  const VF sub = hn::Mul(px, hn::Set(d, static_cast<float>(contract::kSub)));
  const VF magic = hn::Set(d, kRoundFloat);
  const VF rounded = hn::Add(hn::Min(hn::Max(sub, hn::Neg(limit)), limit), magic);
  return hn::Sub(hn::BitCast(DI{}, rounded), hn::BitCast(DI{}, magic));
}

// units(v…) in double, rounded half to even, above the head-room.
template <typename Units, class... V>
HWY_INLINE VI round_depth(Units&& units, V... v) {
  const auto whole_units = [&](auto... wide_v) HWY_ATTR {
    auto exact = units(wide_v...);
    const auto magic = hn::Set(hn::DFromV<decltype(exact)>{}, kRoundDouble);
    return hn::Sub(hn::Add(exact, magic), magic);
  };
  return hn::Add(in_double(DI{}, whole_units, v...), hn::Set(DI{}, contract::kDepthHead));
}

HWY_INLINE VI quantize_depth(VF depth01) {
  const DF d;
  const VF clamped = hn::Min(hn::Max(depth01, hn::Zero(d)), hn::Set(d, 1.0f));
  const auto units = [](auto v) HWY_ATTR {
    return hn::Mul(v, hn::Set(hn::DFromV<decltype(v)>{}, double{contract::kDepthRange}));
  };
  return round_depth(units, clamped);
}

HWY_INLINE VI view_depth(const ViewDepth& depth, VF w) {
  const auto units = [&](auto v) HWY_ATTR {
    const hn::DFromV<decltype(v)> d;
    const auto exact = hn::Div(hn::Mul(hn::Sub(v, hn::Set(d, depth.near_z)), hn::Set(d, depth.scale)), v);
    return hn::Min(hn::Max(exact, hn::Zero(d)), hn::Set(d, double{contract::kDepthRange}));
  };
  return round_depth(units, w);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

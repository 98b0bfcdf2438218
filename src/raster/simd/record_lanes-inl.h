// Loads triangles that are consecutive in memory into vectors of 32-bit lanes.
//
// A triangle record is five pairs of 32-bit fields. kPairs records fill five vectors of kPairs pairs. kPairs
// is a power of two and five is odd, so in these vectors the kPairs pairs of one field all lie in different
// lanes. They are blended into one vector and ordered by a permutation, which is much cheaper than gathers.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstdint>

#include "core/lanes-inl.h"
#include "edgewise/screen_triangle.h"

// Included once per SIMD target.
#if defined(EDGEWISE_RECORD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_RECORD_LANES_INL_H
#undef EDGEWISE_RECORD_LANES_INL_H
#else
#define EDGEWISE_RECORD_LANES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR  // the scalar target has no pairs of lanes

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Pairs = hn::Repartition<std::int64_t, D>;
constexpr int kPairs = static_cast<int>(hn::MaxLanes(Pairs{}));
constexpr int kFields = sizeof(ScreenTriangle) / sizeof(std::int64_t);
static_assert(kFields == 5);

// remainder: lane % kFields. lane: for each field, the lane of each record's pair in the blend.
alignas(64) constexpr auto kPairTables = [] {
  struct {
    std::int64_t remainder[kPairs], lane[kFields][kPairs];
  } t{};
  for (int i = 0; i < kPairs; ++i) {
    t.remainder[i] = i % kFields;
    for (int field = 0; field < kFields; ++field) t.lane[field][i] = (kFields * i + field) % kPairs;
  }
  return t;
}();

// Loads kPairs records. field[f]: pair f of each record.
HWY_INLINE void load_pairs(const std::int64_t* from, hn::Vec<Pairs> (&field)[kFields]) {
  const Pairs d;
  hn::Vec<Pairs> loaded[kFields];
  for (int p = 0; p < kFields; ++p) loaded[p] = hn::LoadU(d, from + p * kPairs);
  const auto remainder = hn::LoadU(d, kPairTables.remainder);
  hn::Mask<Pairs> is[kFields];
  for (int r = 0; r < kFields; ++r) is[r] = hn::Eq(remainder, hn::Set(d, r));
  for (int f = 0; f < kFields; ++f) {
    auto v = loaded[0];
    for (int p = 1; p < kFields; ++p) {
      const int r = ((f - p * kPairs) % kFields + kFields) % kFields;
      if (r < kPairs) v = hn::IfThenElse(is[r], loaded[p], v);
    }
    field[f] = hn::TableLookupLanes(v, hn::SetTableIndices(d, kPairTables.lane[f]));
  }
}

constexpr std::size_t kPrefetchBytes = 2560;  // prefetch distance

struct RecordLanes {
  V x[3], y[3], z[3], payload;

  // Loads kLanes triangles. `prefetch`: prefetch triangles that follow in memory.
  HWY_INLINE RecordLanes(const ScreenTriangle* triangles, bool prefetch) {
    const D d;
    if (prefetch)
      for (std::size_t i = 0; i < kLanes * sizeof(ScreenTriangle); i += 64)
        hwy::Prefetch(reinterpret_cast<const char*>(triangles) + kPrefetchBytes + i);
    hn::Vec<Pairs> first[kFields], second[kFields];
    load_pairs(reinterpret_cast<const std::int64_t*>(triangles), first);
    load_pairs(reinterpret_cast<const std::int64_t*>(triangles + kPairs), second);
    const auto even = [&](int f) {
      return hn::ConcatEven(d, hn::BitCast(d, second[f]), hn::BitCast(d, first[f]));
    };
    const auto odd = [&](int f) {
      return hn::ConcatOdd(d, hn::BitCast(d, second[f]), hn::BitCast(d, first[f]));
    };
    x[0] = even(0), x[1] = odd(0), x[2] = even(1);
    y[0] = odd(1), y[1] = even(2), y[2] = odd(2);
    z[0] = even(3), z[1] = odd(3), z[2] = even(4);
    payload = odd(4);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif

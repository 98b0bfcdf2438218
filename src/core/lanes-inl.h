// Vectors of up to sixteen 32-bit lanes, used for pixels, blocks, vertices and triangles: masks as bits,
// selection of lanes, and transposition of records.
#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "core/little_endian.h"
#include "edgewise/screen_triangle.h"

// Included once per SIMD target.
#if defined(EDGEWISE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_LANES_INL_H
#undef EDGEWISE_LANES_INL_H
#else
#define EDGEWISE_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
using DF = hn::Rebind<float, D>;
using VF = hn::Vec<DF>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D{}));
constexpr int kBatch = 32;  // triangles of a segment that a kernel sets up together, at most

// first, first + 1 … Not Iota(first): Highway 1.0.3 builds it in memory lane by lane, and the vector load
// waits for all of these stores.
HWY_INLINE V counting_from(int first) {
  return hn::Add(hn::Iota(D{}, 0), hn::Set(D{}, first));
}

HWY_INLINE std::uint32_t mask_bits(hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D{}, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return little_endian(bits);
}

// Stores the lanes of a mask. Masked stores, which AVX-512 has, draw meshes up to 1.06× faster (sphere,
// terrain and torus-knot on one thread, Zen 4).
HWY_INLINE void replace(std::int32_t* at, hn::Mask<D> where, V v) {
#if HWY_TARGET <= HWY_AVX3  // the better the target, the lower its number
  hn::BlendedStore(v, where, D{}, at);
#else
  hn::StoreU(hn::IfThenElse(where, v, hn::LoadU(D{}, at)), D{}, at);
#endif
}

// vzeroupper, without which GCC 12 ends some kernels. The caller's SSE code would then merge into registers
// whose upper halves are in use, and run at half speed until the next context switch.
HWY_INLINE void clear_upper_halves() {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2  // the better the target, the lower its number
  _mm256_zeroupper();
#endif
}

#if HWY_MAX_BYTES == 16 || HWY_TARGET == HWY_AVX2
// For each mask, the indices of its selected lanes, followed by 0s. Compress() of Highway 1.0.3 has the same
// table, but GCC copies it to the stack at every call.
constexpr auto kLanesOfMask = [] {
  struct {
    std::uint8_t lane[1 << kLanes][kLanes];
  } table{};
  for (int mask = 0; mask < 1 << kLanes; ++mask) {
    int count = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      if (mask >> lane & 1) table.lane[mask][count++] = static_cast<std::uint8_t>(lane);
  }
  return table;
}();
// Moves the lanes of a mask to the front, in order. The lanes behind them are unspecified.
class Selection {
 public:
  HWY_INLINE explicit Selection(hn::Mask<D> mask)
      : lanes_(hn::IndicesFromVec(D{}, hn::PromoteTo(D{}, hn::LoadU(hn::Rebind<std::uint8_t, D>{},
                                                                    kLanesOfMask.lane[mask_bits(mask)])))) {}
  HWY_INLINE V operator()(V v) const { return hn::TableLookupLanes(v, lanes_); }

 private:
  decltype(hn::IndicesFromVec(D{}, V{})) lanes_;
};
#else
class Selection {
 public:
  HWY_INLINE explicit Selection(hn::Mask<D> mask) : mask_(mask) {}
  HWY_INLINE V operator()(V v) const { return hn::Compress(v, mask_); }

 private:
  hn::Mask<D> mask_;
};
#endif

// Records in memory ↔ vectors with one record per lane, by transpositions of four words of four records: one
// memory access per record, where gathers need one per word.

// Four words of each lane's record: word[k] holds word k of all lanes.
struct Words {
  V word[4];
};

#if HWY_TARGET == HWY_SCALAR

template <typename At>
HWY_INLINE Words load_words(At&& at, int first = 0) {
  const D d;
  std::int32_t word[4];
  std::memcpy(word, reinterpret_cast<const std::int32_t*>(at(0)) + first, sizeof word);  // they may be floats
  return {{hn::Set(d, word[0]), hn::Set(d, word[1]), hn::Set(d, word[2]), hn::Set(d, word[3])}};
}

template <typename At>
HWY_INLINE void store_words(const Words& w, At&& at) {
  for (int k = 0; k < 4; ++k) hn::StoreU(w.word[k], D{}, at(0) + k);
}

#else

// Loads four words of the records of `lane`, lane + 4, lane + 8, …, from word `first` on, into consecutive
// blocks of four lanes.
template <class Tag, typename At>
HWY_INLINE hn::Vec<Tag> load_blocks(Tag d, At&& at, int lane, int first) {
  if constexpr (hn::MaxLanes(Tag{}) == 4) {
    return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(at(lane)) + first);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(d, load_blocks(half, at, lane + hn::MaxLanes(Tag{}) / 2, first),
                       load_blocks(half, at, lane, first));
  }
}

HWY_INLINE Words transpose(const Words& w) {
  const D d;
  const hn::Repartition<std::int64_t, D> pairs;
  const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, w.word[0], w.word[1]));
  const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, w.word[2], w.word[3]));
  const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, w.word[0], w.word[1]));
  const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, w.word[2], w.word[3]));
  return {{hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)),
           hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23))}};
}

// at(lane) points to the record of a lane, of any 32-bit type. Loads its words first … first + 3.
template <typename At>
HWY_INLINE Words load_words(At&& at, int first = 0) {
  return transpose({{load_blocks(D{}, at, 0, first), load_blocks(D{}, at, 1, first),
                     load_blocks(D{}, at, 2, first), load_blocks(D{}, at, 3, first)}});
}

template <class Vector, typename At>
HWY_INLINE void store_records(const Vector (&blocks)[4], At&& at) {
  using Tag = hn::DFromV<Vector>;
  if constexpr (hn::MaxLanes(Tag{}) == 4) {
    for (int k = 0; k < 4; ++k) hn::StoreU(blocks[k], Tag{}, at(k));
  } else {
    const hn::Half<Tag> half;
    using HalfVector = hn::Vec<hn::Half<Tag> >;
    const HalfVector lower[4] = {hn::LowerHalf(half, blocks[0]), hn::LowerHalf(half, blocks[1]),
                                 hn::LowerHalf(half, blocks[2]), hn::LowerHalf(half, blocks[3])};
    const HalfVector upper[4] = {hn::UpperHalf(half, blocks[0]), hn::UpperHalf(half, blocks[1]),
                                 hn::UpperHalf(half, blocks[2]), hn::UpperHalf(half, blocks[3])};
    constexpr int kUpper = hn::MaxLanes(Tag{}) / 2;
    store_records(lower, at);
    store_records(upper, [&](int lane) { return at(lane + kUpper); });
  }
}

// Stores in the order of the lanes: if two lanes have the same address, the later one stays.
template <typename At>
HWY_INLINE void store_words(const Words& words, At&& at) {
  store_records(transpose(words).word, at);
}

#endif

// Triangles, one per lane.
struct TriangleLanes {
  V x[3], y[3], z[3], payload;
};

// at(lane) points to the triangle of a lane.
template <typename At>
HWY_INLINE TriangleLanes load_triangles(At&& at) {
  // Reads words 6 and 7 twice: ten in all.
  const Words a = load_words(at), b = load_words(at, 4), c = load_words(at, 6);
  return {{a.word[0], a.word[1], a.word[2]},
          {a.word[3], b.word[0], b.word[1]},
          {b.word[2], b.word[3], c.word[2]},
          c.word[3]};
}

// As store_words().
template <typename At>
HWY_INLINE void store_triangles(const TriangleLanes& t, At&& at) {
  const auto store = [&](int first, V v0, V v1, V v2, V v3) {
    store_words({{v0, v1, v2, v3}},
                [&](int lane) { return reinterpret_cast<std::int32_t*>(at(lane)) + first; });
  };
  store(0, t.x[0], t.x[1], t.x[2], t.y[0]);
  store(4, t.y[1], t.y[2], t.z[0], t.z[1]);
  store(6, t.z[0], t.z[1], t.z[2], t.payload);  // writes words 6 and 7 again
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

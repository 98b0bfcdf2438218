// Vectors of up to sixteen 32-bit lanes, used for pixels, blocks and triangles: masks as bits, and selection
// of lanes.
#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "core/little_endian.h"

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

// Some kernels end without this instruction (GCC 12). The caller's SSE code would then merge into registers
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

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

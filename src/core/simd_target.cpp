#include "edgewise/simd_target.h"

#include <hwy/targets.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace edgewise {

std::span<const SimdTarget> supported_targets() {
  static const auto& supported = *new auto([] {  // threads may draw until the process has ended
    auto compiled_and_runnable = HWY_TARGETS;
    // The static target runs wherever this file does. Highway 1.0.3 would ask for more: NEON with AES.
#if HWY_TARGETS & ~(HWY_STATIC_TARGET | HWY_SCALAR)
    compiled_and_runnable &= hwy::SupportedTargets();
#endif
    std::vector<SimdTarget> list{SimdTarget::scalar};
    if (compiled_and_runnable & HWY_SSE4) list.push_back(SimdTarget::sse4);
    if (compiled_and_runnable & HWY_AVX2) list.push_back(SimdTarget::avx2);
    if (compiled_and_runnable & HWY_AVX3) list.push_back(SimdTarget::avx512);
    if (compiled_and_runnable & HWY_NEON) list.push_back(SimdTarget::neon);
    return list;
  }());
  return supported;
}

// Initialized when the library is loaded: a child forked during a later initialization would wait for its
// lock.
[[maybe_unused]] static const auto kMade = supported_targets();

std::string_view name_of(SimdTarget target) {
  constexpr std::array<std::string_view, 6> kNames{"scalar", "sse4", "avx2", "avx512", "neon", "best"};
  static_assert(static_cast<std::size_t>(SimdTarget::best) + 1 == kNames.size());
  const auto i = static_cast<std::size_t>(target);
  if (i >= kNames.size()) throw std::invalid_argument("not a SIMD target");
  return kNames[i];
}

SimdTarget resolve(SimdTarget target) {
  const auto supported = supported_targets();
  if (target == SimdTarget::best) return supported.back();
  for (const auto s : supported)
    if (s == target) return s;
  throw std::invalid_argument("this machine cannot run SIMD target '" + std::string(name_of(target)) + "'");
}

}  // namespace edgewise

#include "edgewise/simd_target.h"

#include <hwy/targets.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace edgewise {

std::span<const SimdTarget> supported_targets() {
  static const auto supported = [] {
    const auto compiled_and_runnable = HWY_TARGETS & hwy::SupportedTargets();
    std::vector<SimdTarget> list{SimdTarget::scalar};
    if (compiled_and_runnable & HWY_SSE4) list.push_back(SimdTarget::sse4);
    if (compiled_and_runnable & HWY_AVX2) list.push_back(SimdTarget::avx2);
    if (compiled_and_runnable & HWY_AVX3) list.push_back(SimdTarget::avx512);
    return list;
  }();
  return supported;
}

std::string_view name_of(SimdTarget target) {
  switch (target) {
    case SimdTarget::scalar:
      return "scalar";
    case SimdTarget::sse4:
      return "sse4";
    case SimdTarget::avx2:
      return "avx2";
    case SimdTarget::avx512:
      return "avx512";
    case SimdTarget::best:
      return "best";
  }
  throw std::invalid_argument("not a SIMD target");
}

SimdTarget resolve(SimdTarget target) {
  const auto supported = supported_targets();
  if (target == SimdTarget::best) return supported.back();
  for (const auto s : supported)
    if (s == target) return s;
  throw std::invalid_argument("this machine cannot run SIMD target '" + std::string(name_of(target)) + "'");
}

}  // namespace edgewise

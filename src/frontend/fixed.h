// Float → fixed point: the only place where it happens (rules 2, 3 and 6 of the contract).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "raster/contract.h"

namespace edgewise {

// Half to even, for |v| <= 2^22: adding 1.5 * 2^23 leaves no fraction bits, so the sum is rounded by the
// FPU's default mode, and its bit pattern counts in ones.
inline std::int32_t round_half_even(float v) {
  constexpr float kMagic = 12582912.0f;
  return std::bit_cast<std::int32_t>(v + kMagic) - std::bit_cast<std::int32_t>(kMagic);
}

// Pixels → sub-units, clamped to the guard band, which a clipped vertex may miss by a rounding error.
inline std::int32_t snap(float px) {
  constexpr float kLimit = static_cast<float>(contract::kGuardSub);
  return round_half_even(std::clamp(px * static_cast<float>(contract::kSub), -kLimit, kLimit));
}

// Depth in [0, 1] (clamped) → contract units, half to even by the same trick in double.
inline std::uint32_t quantize_depth(float depth01) {
  constexpr double kMagic = 6755399441055744.0;  // 1.5 * 2^52
  const double units = static_cast<double>(std::clamp(depth01, 0.0f, 1.0f)) * contract::kDepthRange;
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(units + kMagic) -
                                    std::bit_cast<std::uint64_t>(kMagic)) +
         contract::kDepthHead;
}

}  // namespace edgewise

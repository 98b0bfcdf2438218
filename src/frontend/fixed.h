// Float → fixed point, for one value (rules 2, 3 and 6 of the contract). lanes-inl.h has the same for
// vectors.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

// A sum with one of these has no fraction bits: the addition rounds half to even, the FPU's default mode, and
// the sum's bit pattern counts whole units.
inline constexpr float kRoundFloat = 12582912.0f;           // 1.5 * 2^23, for |v| <= 2^22
inline constexpr double kRoundDouble = 6755399441055744.0;  // 1.5 * 2^52, for |v| <= 2^51

inline std::int32_t round_half_even(float v) {
  return std::bit_cast<std::int32_t>(v + kRoundFloat) - std::bit_cast<std::int32_t>(kRoundFloat);
}

// Pixels → sub-units, clamped to the guard band: rounding may put a clipped vertex slightly beyond it.
inline std::int32_t snap(float px) {
  constexpr float kLimit = static_cast<float>(contract::kGuardSub);
  return round_half_even(std::clamp(px * static_cast<float>(contract::kSub), -kLimit, kLimit));
}

// Depth, clamped to [0, 1] → contract units, half to even for every float. The product is exact (rule 6), so
// only the addition rounds. The sum lies between 2^52 and 2^53, so it rounds to whole units.
inline std::uint32_t quantize_depth(float depth01) {
  const double units = static_cast<double>(std::clamp(depth01, 0.0f, 1.0f)) * contract::kDepthRange;
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(units + kRoundDouble) -
                                    std::bit_cast<std::uint64_t>(kRoundDouble)) +
         contract::kDepthHead;
}

}  // namespace edgewise

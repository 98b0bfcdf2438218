// Float → fixed point: the only place where it happens (rules 2, 3 and 6 of the contract).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

// Adding one of these leaves no fraction bits, so the sum is rounded by the FPU's default mode, half to even,
// and its bit pattern counts in ones.
inline constexpr float kRoundFloat = 12582912.0f;           // 1.5 * 2^23, for |v| <= 2^22
inline constexpr double kRoundDouble = 6755399441055744.0;  // 1.5 * 2^52, for |v| <= 2^51

inline std::int32_t round_half_even(float v) {
  return std::bit_cast<std::int32_t>(v + kRoundFloat) - std::bit_cast<std::int32_t>(kRoundFloat);
}

// Pixels → sub-units, clamped to the guard band, which a clipped vertex may miss by a rounding error.
inline std::int32_t snap(float px) {
  constexpr float kLimit = static_cast<float>(contract::kGuardSub);
  return round_half_even(std::clamp(px * static_cast<float>(contract::kSub), -kLimit, kLimit));
}

// Depth in [0, 1] (clamped) → contract units, half to even for every float: the product is exact (rule 6), so
// the addition is the only operation that rounds. As the sum lies between 2^52 and 2^53, it rounds to whole
// units.
inline std::uint32_t quantize_depth(float depth01) {
  const double units = static_cast<double>(std::clamp(depth01, 0.0f, 1.0f)) * contract::kDepthRange;
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(units + kRoundDouble) -
                                    std::bit_cast<std::uint64_t>(kRoundDouble)) +
         contract::kDepthHead;
}

}  // namespace edgewise

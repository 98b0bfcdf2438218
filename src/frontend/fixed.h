// Float → fixed point, for one value (rules 2, 3 and 6 of the contract). lanes-inl.h has the same for
// vectors.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/grid.h"
#include "edgewise/contract.h"

namespace edgewise {

// A sum with one of these has no fraction bits: the addition rounds half to even, the FPU's default mode, and
// the sum's bit pattern counts whole units.
inline constexpr float kRoundFloat = 12582912.0f;           // 1.5 * 2^23, for |v| <= 2^22
inline constexpr double kRoundDouble = 6755399441055744.0;  // 1.5 * 2^52, for |v| <= 2^51

inline std::int32_t round_half_even(float v) {
  return std::bit_cast<std::int32_t>(v + kRoundFloat) - std::bit_cast<std::int32_t>(kRoundFloat);
}

// Pixels → 2^-15 px with 8 subpixel bits, clamped to the guard band: rounding may put a clipped vertex
// slightly beyond it.
inline std::int32_t snap(float px) {
  constexpr float kLimit = Coarse::kGuardSub;
  return round_half_even(std::clamp(px * Coarse::kSub, -kLimit, kLimit)) * (1 << Coarse::kSpareBits);
}

// Units above depth 0, clamped to the range → contract units, half to even. The sum lies between 2^52 and
// 2^53, so it rounds to whole units.
inline std::uint32_t round_depth(double units) {
  const double clamped = std::clamp(units, 0.0, double{contract::kDepthRange});
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(clamped + kRoundDouble) -
                                    std::bit_cast<std::uint64_t>(kRoundDouble)) +
         contract::kDepthHead;
}

// Depth, clamped to [0, 1] → contract units, half to even for every float: the product is exact (rule 6), so
// only one operation rounds.
inline std::uint32_t quantize_depth(float depth01) {
  return round_depth(double{depth01} * contract::kDepthRange);
}

// Distance along the view direction, which is w → contract units, clamped to near … far:
//   depth = far / (far - near) (1 - near / w) = far (w - near) / ((far - near) w)
// A float z / w would be too coarse: far from the near plane it is close to 1, where floats are 2^-24 apart,
// 128 units. The second form is used because the first one cancels near the near plane. Its rounding errors
// in double add up to less than 2^-19 units, so the result is within 1/2 + 2^-19 units of the exact depth.
struct ViewDepth {
  ViewDepth(double near_distance, double far_distance)
      : near_z(near_distance),
        scale(contract::kDepthRange * (far_distance / (far_distance - near_distance))) {}

  double above_near(double w) const { return (w - near_z) * scale / w; }  // in units
  std::uint32_t units(double w) const { return round_depth(above_near(w)); }

  double near_z, scale;
};

}  // namespace edgewise

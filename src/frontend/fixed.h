// Float → fixed point, for one value (rules 2, 3 and 6 of the contract). lanes-inl.h has the same for
// vectors.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/grid.h"
#include "edgewise/contract.h"

namespace edgewise {

// Positions with more subpixel bits are computed in double, others in float.
constexpr bool is_fine(int subpixel_bits) {
  return subpixel_bits > Coarse::kSubBits;
}

// GCC 12 drops the conversion of two or more doubles to float and back when it vectorizes it. So a
// `volatile`.
inline double rounded_to_float(double v) {
  const volatile float rounded = static_cast<float>(v);
  return double{rounded};
}

// A sum with this has no fraction bits: the addition rounds half to even, the FPU's default mode, and the
// sum's bit pattern counts whole units.
inline constexpr double kRoundDouble = 6755399441055744.0;  // 1.5 * 2^52, for |v| <= 2^51

// The same for units of 2^-fraction_bits.
constexpr double rounding_to(int fraction_bits) {
  return kRoundDouble / (1 << fraction_bits);
}

// Pixels → 2^-15 px, clamped to the guard band: rounding may put a clipped vertex slightly beyond it.
inline std::int32_t snap(double px, int subpixel_bits = Coarse::kSubBits) {
  constexpr double kGuardPx = contract::kMaxImageSide;
  const double round = rounding_to(subpixel_bits);
  const std::uint64_t units = std::bit_cast<std::uint64_t>(std::clamp(px, -kGuardPx, kGuardPx) + round) -
                              std::bit_cast<std::uint64_t>(round);
  return static_cast<std::int32_t>(units << (contract::kFineBits - subpixel_bits));
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
// only one operation rounds. Of other doubles, the result is within 1/2 + 2^-22 units.
inline std::uint32_t quantize_depth(double depth01) {
  return round_depth(depth01 * contract::kDepthRange);
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

// The grids of positions on which kernels compute.
//
// Positions have 15 fraction bits (rule 1 of contract.h). Front ends that use 8 of them leave the others 0.
// Kernels are templates over the grid. On the coarse one they drop the spare bits where they load triangles,
// so that edge values fit 32 bits in every tile (rule 5). A draw is coarse if all spare bits are 0.
#pragma once

#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

template <int kBits>
struct Grid {
  static constexpr int kSubBits = kBits;
  static constexpr int kSpareBits = contract::kFineBits - kBits;
  static constexpr std::int32_t kSub = 1 << kBits, kHalf = kSub / 2;  // sub-units: of 2^-kBits px
  static constexpr std::int32_t kGuardSub = contract::kGuard_q15 >> kSpareBits;
  static constexpr int kPlaneBits = 16 + kBits;  // fraction bits of a depth plane's value (rule 6)
  // The sample of a pixel, in sub-units.
  static constexpr std::int32_t sample(std::int32_t px) { return px * kSub + kHalf; }
};

using Coarse = Grid<8>;
using Fine = Grid<contract::kFineBits>;

}  // namespace edgewise

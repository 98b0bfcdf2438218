// The SIMD targets that kernels are compiled for, chosen at run time. Any thread may call anything here.
#pragma once

#include "edgewise/cxx20.h"

#include <span>
#include <string_view>

namespace edgewise {

// All draw the same bits.
enum class SimdTarget { scalar, sse4, avx2, avx512, best };

// The targets that were compiled and that this machine can run, slowest first; `best` stands for the last.
std::span<const SimdTarget> supported_targets();

// "scalar", "sse4", "avx2", "avx512" or "best".
std::string_view name_of(SimdTarget target);

// `best` becomes the last supported target. Throws std::invalid_argument for one that this machine cannot
// run.
SimdTarget resolve(SimdTarget target);

}  // namespace edgewise

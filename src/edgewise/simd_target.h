// The SIMD instruction sets that kernels are compiled for, chosen at run time. Any thread may call these
// functions.
#pragma once

#include "edgewise/cxx20.h"

#include <span>
#include <string_view>

#pragma GCC visibility push(default)
namespace edgewise {

// All targets draw the same bits.
enum class SimdTarget { scalar, sse4, avx2, avx512, neon, best };

// The targets that are compiled in and that this machine can run, slowest first. `best` means the last one.
std::span<const SimdTarget> supported_targets();

// "scalar", "sse4", "avx2", "avx512", "neon" or "best".
std::string_view name_of(SimdTarget target);

// Turns `best` into the last supported target and returns any other unchanged. Throws std::invalid_argument
// for a target that this machine cannot run.
SimdTarget resolve(SimdTarget target);

}  // namespace edgewise
#pragma GCC visibility pop

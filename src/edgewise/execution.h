// How front end and backends run.
#pragma once

#include "edgewise/cxx20.h"

#include "edgewise/limits.h"
#include "edgewise/simd_target.h"

namespace edgewise {

// No choice here changes a bit of a result. Functions that take an Execution throw std::invalid_argument for
// a value that is out of range, and for a SIMD target that this machine cannot run.
struct Execution {
  int threads = 1;     // at most; 1 … kMaxThreads. oneTBB's limit holds too: by default, as many as cores
  int tile_size = 64;  // px; 16, 32 or 64; used by traversals in tiles only
  SimdTarget target = SimdTarget::best;
};

}  // namespace edgewise

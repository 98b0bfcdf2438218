// The backend `tiled` as a laboratory: the same snapped vertices, binning, tiles, coarse rejection, depths
// and threads, with other arithmetic in the edge functions. It answers what exact coverage costs, and what
// inexact coverage gets wrong, with all else equal.
#pragma once

#include <memory>

#include "edgewise/backend.h"
#include "raster/kernels.h"

namespace edgewise::lab {

enum class EngineArithmetic {
  exact,  // the contract's: int32, relative to the tile
  int64,
  float64,
  float32,
  float32_rebased,  // relative to the tile
  int32             // wraps where edge values exceed 32 bits
};

// The tile kernel in this arithmetic. `target` must be resolved.
TileKernel engine_kernel(EngineArithmetic arithmetic, SimdTarget target);

// In exact arithmetic this is the composition `tiles+edges+hiz`.
std::unique_ptr<Backend> make_engine(EngineArithmetic arithmetic);

}  // namespace edgewise::lab

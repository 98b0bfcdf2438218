// The backend `tiled` as a laboratory: the same snapped vertices, binning, tiles, coarse rejection, depths
// and threads, with other arithmetic in the edge functions. It answers what exact coverage costs, and what
// inexact coverage gets wrong, with all else equal.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/backend.h"
#include "lab/coverage/coverage.h"
#include "raster/kernels.h"
#include "raster/tiles.h"

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

// Draws a frame. `scratch` is kept between frames. In exact arithmetic this is the backend `tiled` without
// coverage masks.
void draw_engine(EngineArithmetic arithmetic, std::span<const ScreenTriangle> triangles, FrameView frame,
                 std::uint32_t background, const Execution& execution, TileScratch& scratch);

// The engine with each kind of arithmetic, the contract's first. Apart from coverage_methods(), because
// sweeps and the viewer leave them out.
std::span<const CoverageMethod> engine_methods();

}  // namespace edgewise::lab

// The backend `tiled` as a laboratory: the same binning, tiles, blocks, coarse rejection, depth and threads,
// with other numbers in the edge functions. It answers what exact coverage costs, and what inexact coverage
// gets wrong, with all else equal.
#pragma once

#include <span>
#include <string_view>

#include "lab/coverage/coverage.h"
#include "lab/engine/engine_kernel.h"

namespace edgewise::lab {

// Draws a frame. input.snapped is relative to the window's corner, input.floats is not. `scratch` is kept
// between frames. For exact numbers this is the backend `tiled` without coverage masks.
void draw_engine(EngineNumbers numbers, const CoverageInput& input, Window window, FrameView frame,
                 std::uint32_t background, const Execution& execution, TileScratch& scratch);

// The engine with each kind of numbers, the contract's first. Apart from coverage_methods(), because sweeps
// and the viewer leave them out.
std::span<const CoverageMethod> engine_methods();

}  // namespace edgewise::lab

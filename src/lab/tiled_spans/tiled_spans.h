// The tile renderer of `tiled` with spans in place of edge functions: the same binning, tiles, threads and
// tile stores, with hierarchical depth and coverage masks as switches.
#pragma once

#include <memory>

#include "edgewise/backend.h"
#include "raster/ablation.h"
#include "raster/tile_task.h"

namespace edgewise::lab {

// The kernel that draws a tile of contract::kMaxTile px. `target` must be resolved.
TileKernel tiled_spans_kernel(SimdTarget target);

// Switches are those of `tiled`.
std::unique_ptr<Backend> make_tiled_spans(const Ablation& ablation);

}  // namespace edgewise::lab

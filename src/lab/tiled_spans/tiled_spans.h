// The tile renderer of `tiled` with spans in place of edge functions: the same binning, tiles, threads, tile
// stores and options.
#pragma once

#include <memory>

#include "edgewise/backend.h"
#include "raster/tile_options.h"
#include "raster/tile_task.h"

namespace edgewise::lab {

// The kernel that draws a tile of contract::kMaxTile px. `target` must be resolved.
TileKernel tiled_spans_kernel(SimdTarget target);

std::unique_ptr<Backend> make_tiled_spans(const TileOptions& options);

}  // namespace edgewise::lab

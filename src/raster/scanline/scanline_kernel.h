// Draws one tile of the image row by row, span by span. See scanline_kernel.cpp for the ideas.
#pragma once

#include "raster/tile_task.h"

namespace edgewise {

// `target` must be resolved. Its tiles are contract::kMaxTile px a side.
TileKernel scanline_kernel(SimdTarget target);

}  // namespace edgewise

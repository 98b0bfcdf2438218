// The kernel that draws one tile of the image by spans. See scanline_kernel.cpp.
#pragma once

#include "raster/tile_task.h"

namespace edgewise {

// `target` must be resolved. Tiles must have sides of contract::kMaxTile px.
TileKernel scanline_kernel(SimdTarget target);

}  // namespace edgewise

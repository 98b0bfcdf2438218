// Draws one tile of the image, in a buffer that stays in the L1 cache. See tile_kernel.cpp.
#pragma once

#include "raster/tile_task.h"

namespace edgewise {

// `target` must be resolved.
TileKernel tile_kernel(SimdTarget target);

}  // namespace edgewise

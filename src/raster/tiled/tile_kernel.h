// The kernel that draws one tile of the image, in a buffer sized for the L1 cache. See tile_kernel.cpp.
#pragma once

#include "raster/tile_task.h"

namespace edgewise {

// `target` must be resolved.
TileKernel tile_kernel(SimdTarget target);

}  // namespace edgewise

// `scanline` with edge functions in place of spans, for triangles of any size.
#pragma once

#include "raster/bands.h"

namespace edgewise::lab {

// `target` must be resolved. With vectors, narrow triangles are drawn as in `scanline`.
BandKernel band_edges_kernel(SimdTarget target);

}  // namespace edgewise::lab

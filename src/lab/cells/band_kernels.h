// `scanline` with one way to fill for triangles of any size.
#pragma once

#include "raster/bands.h"

namespace edgewise::lab {

// `target` must be resolved.
BandKernel band_spans_kernel(SimdTarget target);
// Edge functions. With vectors, narrow triangles are drawn as in `scanline`.
BandKernel band_edges_kernel(SimdTarget target);

}  // namespace edgewise::lab

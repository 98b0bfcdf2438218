// Drawing in horizontal bands: a thread clears a band and draws its triangles in the frame itself.
#pragma once

#include <memory>

#include "edgewise/backend.h"
#include "raster/kernels.h"

namespace edgewise {

// `fill` returns the kernel that draws a band.
std::unique_ptr<Backend> make_bands(FrameKernel (*fill)(SimdTarget));

}  // namespace edgewise

// Fills the tiles that no triangle may cover. All such tiles of a row are filled together, pixel row by pixel
// row: memory takes long runs of consecutive stores twice as fast as one tile after the other.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/simd_target.h"
#include "raster/binning/bins.h"

namespace edgewise {

struct EmptyTiles {
  std::span<const Bins::Run> runs;  // of one row of tiles
  int y0;                           // px, the row's first pixel
  int size_log2;                    // px
  FrameView frame;
  std::uint32_t background;
  bool streaming;  // requested
};

using EmptyTilesKernel = void (*)(const EmptyTiles&);

// `target` must be resolved.
EmptyTilesKernel empty_tiles_kernel(SimdTarget target);

}  // namespace edgewise

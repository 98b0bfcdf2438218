// Fills the tiles without triangles. All those of a row are filled together, pixel row by pixel row: long
// consecutive stores use the memory's bandwidth better than the short rows of one tile after the other.
#pragma once

#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/simd_target.h"
#include "raster/tile_list.h"

namespace edgewise {

struct EmptyTiles {
  std::span<const TileSpan> tiles;  // of one row
  int y0, y1;                       // the pixel rows y0 … y1 - 1
  int size_log2;                    // px, of a tile
  FrameView frame;
  std::uint32_t background;
  bool streaming;  // requested
};

using EmptyTilesKernel = void (*)(const EmptyTiles&);

// `target` must be resolved.
EmptyTilesKernel empty_tiles_kernel(SimdTarget target);

}  // namespace edgewise

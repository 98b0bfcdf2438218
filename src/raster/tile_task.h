// The task of drawing one tile, for backends that draw by tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "edgewise/framebuffer.h"
#include "edgewise/simd_target.h"
#include "raster/binning/bins.h"

namespace edgewise {

struct TileTask {
  const ScreenTriangle* triangles;
  const Bins* bins;
  int cell;       // index of the tile in `bins`
  int x0, y0;     // px, the tile's first pixel; multiples of the tile's size
  int size_log2;  // px; at most 6
  FrameView frame;
  std::uint32_t background;
  bool hierarchical_depth;  // TileOptions::hierarchical_depth
  bool streaming;           // requested

  int size() const { return 1 << size_log2; }  // px
  // The part inside the frame, px.
  int width() const { return std::min(size(), frame.width - x0); }
  int height() const { return std::min(size(), frame.height - y0); }
};

using TileKernel = void (*)(const TileTask&);

// The kernel that draws one tile, in a buffer sized for the L1 cache (tiled/tile_kernel.cpp). `target` must
// be resolved.
TileKernel tile_kernel(SimdTarget target);

}  // namespace edgewise

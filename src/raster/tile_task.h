// The task of drawing one tile, for backends that draw by tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "edgewise/backend.h"
#include "edgewise/simd_target.h"
#include "raster/binning/bins.h"

namespace edgewise {

struct TileTask {
  const ScreenTriangle* triangles;
  const Bins* bins;
  int cell;       // index of the tile in `bins`
  int x0, y0;     // px, the tile's first pixel; multiples of the tile's size
  int size_log2;  // px; at most 6
  FramePart part;
  bool hierarchical_depth;  // TileOptions::hierarchical_depth
  bool streaming;           // requested

  int size() const { return 1 << size_log2; }  // px
  // The tile's columns left() … width() - 1 and rows top() … height() - 1 are drawn, px. The kernel may also
  // draw what lies left of or above them in its buffer, but must not store it.
  int left() const { return std::max(part.x0 - x0, 0); }
  int top() const { return std::max(part.y0 - y0, 0); }
  int width() const { return std::min(size(), part.frame.width - x0); }
  int height() const { return std::min(size(), part.frame.height - y0); }
};

using TileKernel = void (*)(const TileTask&);

// The kernel that draws one tile, in a buffer sized for the L1 cache (tiled/tile_kernel.cpp). `target` must
// be resolved.
TileKernel tile_kernel(SimdTarget target);

}  // namespace edgewise

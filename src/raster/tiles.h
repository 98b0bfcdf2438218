// Drawing in square tiles: triangles are binned to tiles, and tiles are drawn in parallel, each in a buffer.
#pragma once

#include <memory>

#include "core/triangle_source.h"
#include "edgewise/backend.h"
#include "raster/binning/bins.h"
#include "raster/kernels.h"
#include "raster/tile_list.h"
#include "raster/tile_options.h"

namespace edgewise {

// What drawing in tiles keeps between frames.
struct TileScratch {
  Bins bins;
  TileList list;
};

// `draw_light` draws light tiles. If it is null, or tiles with few triangles are streamed, or the frame has
// no payload plane, no tile is light. Returns false if Bins::build() does; then nothing is drawn.
bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, TileKernel draw_tile,
                   FrameKernel draw_light = nullptr);

// `fill` returns the kernel that draws a tile.
std::unique_ptr<Backend> make_tiles(TileKernel (*fill)(SimdTarget), const TileOptions& options);

}  // namespace edgewise

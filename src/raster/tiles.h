// Drawing in square tiles: triangles are binned to tiles, and tiles are drawn in parallel, each in a buffer.
#pragma once

#include <memory>
#include <vector>

#include "core/triangle_source.h"
#include "edgewise/backend.h"
#include "raster/binning/bins.h"
#include "raster/kernels.h"
#include "raster/tile_options.h"

namespace edgewise {

// Draws a tile that has triangles, or clears the tiles of a row of tiles that have none.
struct TilesTask {
  static constexpr int kClearEmpty = -1;
  int cell;    // of the tile in the bins; kClearEmpty: the pixel rows y0 … y1 - 1 of the empty tiles
  int row;     // of tiles
  int y0, y1;  // px, in the part
};

// The tasks of a part of a frame. A row of tiles has a task for each tile with triangles, and then one, or
// several on many threads, for its empty tiles, unless nothing is cleared. `grid`: of the part's frame.
void list_tasks(const Bins& bins, const CellGrid& grid, const FramePart& part, int threads,
                std::vector<TilesTask>& tasks);

// What drawing in tiles keeps between frames.
struct TileScratch {
  Bins bins;
  std::vector<TilesTask> tasks;
};

// Returns false if Bins::build() does; then nothing is drawn.
bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, TileKernel fill);

// `fill` returns the kernel that draws a tile.
std::unique_ptr<Backend> make_tiles(TileKernel (*fill)(SimdTarget), const TileOptions& options);

}  // namespace edgewise

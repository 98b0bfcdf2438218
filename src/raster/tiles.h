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

// Draws a tile in a buffer, or clears the empty and light tiles of a row of tiles and draws the light ones.
struct TileJob {
  static constexpr int kInFrame = -1;
  int cell;    // of the tile in the bins; kInFrame: the pixel rows y0 … y1 - 1 of the row's other tiles
  int row;     // of tiles
  int y0, y1;  // px, in the part; of a tile in a buffer, all its rows there
};

// The jobs of a part of a frame. A row of tiles has a job for each tile drawn in a buffer, and then one, or
// several on many threads, for its other tiles, unless nothing is cleared or drawn there. `grid`: of the
// part's frame. `with_light`: whether tiles may be light.
void list_jobs(const Bins& bins, const CellGrid& grid, const FramePart& part, int threads, bool with_light,
               std::vector<TileJob>& jobs);

// What drawing in tiles keeps between frames.
struct TileScratch {
  Bins bins;
  std::vector<TileJob> jobs;
};

// `draw_light` draws light tiles. If it is null, or clears are streamed, or the frame has no payload plane,
// no tile is light. Returns false if Bins::build() does; then nothing is drawn.
bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, TileKernel fill,
                   FrameKernel draw_light = nullptr);

// `fill` returns the kernel that draws a tile, `light` the one that draws light tiles; null: no tile is
// light.
std::unique_ptr<Backend> make_tiles(TileKernel (*fill)(SimdTarget), const TileOptions& options,
                                    FrameKernel (*light)(SimdTarget) = nullptr);

// The backend `tiled`, with other options than its own.
std::unique_ptr<Backend> make_tiled(const TileOptions& options);

}  // namespace edgewise

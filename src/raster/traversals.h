// The traversals. Bands: a thread clears a band of rows and draws its triangles in the frame itself. Tiles:
// threads draw square tiles in buffers, and store them to the frame.
#pragma once

#include <compare>
#include <functional>
#include <memory>
#include <vector>

#include "edgewise/backend.h"
#include "raster/binning/bins.h"
#include "raster/kernels.h"

namespace edgewise {

// `fill` returns the kernel that draws a band.
std::unique_ptr<Backend> band_backend(FrameKernel (*fill)(SimdTarget));

// How tiles are stored to the frame and cleared there. Streaming (non-temporal) stores save reading the
// frame's old content and leave the caches to the triangles.
enum class TileStore {
  cached,
  streaming,  // leaves no tile light
  automatic   // raster/policy.h
};

// What drawing in tiles can leave out or choose, for compositions, measurements and tests. No option changes
// a bit of the picture.
struct TileOptions {
  bool coverage_masks = true;      // binning resolves small triangles to masks
  bool hierarchical_depth = true;  // triangles behind all that a block or tile shows are rejected
  TileStore tile_store = TileStore::automatic;

  auto operator<=>(const TileOptions&) const = default;
};

// `fill` returns the kernel that draws a tile (lab/engine's has captures), `light` the one that draws light
// tiles. If `light` is null, or clears are streamed, or the frame has no payload plane, no tile is light.
std::unique_ptr<Backend> tile_backend(std::function<TileKernel(SimdTarget)> fill, const TileOptions& options,
                                      FrameKernel (*light)(SimdTarget) = nullptr);

// The backend `tiled`, with other options than its own.
std::unique_ptr<Backend> make_tiled(const TileOptions& options);

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

}  // namespace edgewise

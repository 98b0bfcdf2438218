// Drawing tile by tile, for backends that have a kernel for one tile: triangles are binned to tiles, and
// tiles are drawn in parallel.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/llc.h"
#include "core/parallel.h"
#include "edgewise/backend.h"
#include "raster/ablation.h"
#include "raster/binning/bins.h"
#include "raster/tile_task.h"

namespace edgewise {

// TileStore::automatic. A tile with triangles is streamed: its copy overlaps with the drawing of the next
// tile, and LLC residency is unpredictable, since other processes share the cache. An empty tile is a burst
// of stores that no work overlaps; where the frame can stay in the LLC beside its reader's data, cached
// stores finish it sooner.
constexpr TileStore tile_store_for(bool empty_tile, std::size_t frame_bytes, std::size_t llc) {
  return empty_tile && frame_bytes <= llc / 2 ? TileStore::cached : TileStore::streaming;
}

// `margin`: CellGrid::margin.
template <typename DrawTile>
void draw_in_tiles(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution, const Ablation& ablation, int tile_size, Bins& bins,
                   Bins::Small small, DrawTile&& draw_tile, std::int32_t margin = 0) {
  const int size_log2 = std::countr_zero(static_cast<unsigned>(tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2, margin};
  const SimdTarget binning = ablation.vector_setup ? execution.target : SimdTarget::scalar;
  bins.build(triangles, grid, execution.threads, binning, small, ablation.prefetch);
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
  const int columns = grid.columns();
  parallel_for(execution.threads, grid.cells(), [&](int cell) {
    TileTask task{triangles.data(),
                  &bins,
                  cell,
                  cell % columns << size_log2,
                  cell / columns << size_log2,
                  size_log2,
                  frame,
                  background,
                  ablation};
    if (ablation.tile_store == TileStore::automatic)
      task.ablation.tile_store = tile_store_for(bins.empty(cell), frame_bytes, llc_bytes());
    draw_tile(task);
  });
}

}  // namespace edgewise

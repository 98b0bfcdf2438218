// Drawing tile by tile, for backends that have a kernel for one: triangles are binned to tiles, and tiles are
// drawn on threads.
#pragma once

#include <bit>
#include <span>

#include "raster/backend.h"
#include "raster/bins.h"
#include "raster/last_cache.h"
#include "raster/parallel.h"
#include "raster/tile_kernel.h"

namespace edgewise {

inline WriteOut write_out_for(std::span<const ScreenTriangle> triangles, const FrameView& frame) {
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload)) + triangles.size_bytes();
  return bytes > last_cache_bytes() / 2 ? WriteOut::past_caches : WriteOut::through_caches;
}

inline void draw_in_tiles(std::span<const ScreenTriangle> triangles, FrameView frame,
                          std::uint32_t background, const Execution& execution, int tile_size, Bins& bins,
                          Bins::Small small, TileKernel draw_tile) {
  const int size_log2 = std::countr_zero(static_cast<unsigned>(tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2};
  const SimdTarget binning = execution.ideas.vector_setup ? execution.target : SimdTarget::scalar;
  bins.build(triangles, grid, execution.threads, binning, small, execution.ideas.prefetch);
  TiledIdeas ideas = execution.ideas;
  if (ideas.write_out == WriteOut::by_size) ideas.write_out = write_out_for(triangles, frame);
  const int columns = grid.columns();
  parallel_for(execution.threads, grid.cells(), [&](int cell) {
    draw_tile({triangles.data(), &bins, cell, cell % columns << size_log2, cell / columns << size_log2,
               size_log2, frame, background, ideas});
  });
}

}  // namespace edgewise

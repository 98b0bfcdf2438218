// Drawing tile by tile, for backends that have a kernel for one: triangles are binned to tiles, and tiles are
// drawn on threads.
#pragma once

#include <bit>
#include <span>

#include "edgewise/backend.h"
#include "raster/bins.h"
#include "raster/last_cache.h"
#include "raster/parallel.h"
#include "raster/tile_kernel.h"

namespace edgewise {

// Half of the last cache, since whoever shows the frame and whoever makes the triangles want it, too. A frame
// of 1920 x 1080 is just that on a machine with 32 MiB, where the triangles then decide. Measured there, in
// turns: where next to nothing but the frame is written, stores past the caches take up to twice as long;
// with a MB of triangles neither way wins on idle and on busy machines alike; from two MB on they gain 3 to 8
// % on either. Neither the whole cache as a limit nor the frame alone decides better.
inline WriteOut write_out_for(std::size_t bytes) {
  return bytes > last_cache_bytes() / 2 ? WriteOut::past_caches : WriteOut::through_caches;
}

inline void draw_in_tiles(std::span<const ScreenTriangle> triangles, FrameView frame,
                          std::uint32_t background, const Execution& execution, int tile_size, Bins& bins,
                          Bins::Small small, TileKernel draw_tile) {
  const int size_log2 = std::countr_zero(static_cast<unsigned>(tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2};
  const SimdTarget binning = execution.ideas.vector_setup ? execution.target : SimdTarget::scalar;
  bins.build(triangles, grid, execution.threads, binning, small, execution.ideas.prefetch);
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
  const WriteOut drawn = write_out_for(frame_bytes + triangles.size_bytes());
  // Tiles without triangles are filled in a burst that no work hides, and want nothing else from the caches.
  const WriteOut empty = write_out_for(frame_bytes);
  const int columns = grid.columns();
  parallel_for(execution.threads, grid.cells(), [&](int cell) {
    TiledIdeas ideas = execution.ideas;
    if (ideas.write_out == WriteOut::by_size) ideas.write_out = bins.empty(cell) ? empty : drawn;
    draw_tile({triangles.data(), &bins, cell, cell % columns << size_log2, cell / columns << size_log2,
               size_log2, frame, background, ideas});
  });
}

}  // namespace edgewise

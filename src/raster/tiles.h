// Drawing tile by tile, for backends that have a kernel for one: triangles are binned to tiles, and tiles are
// drawn on threads.
#pragma once

#include <bit>
#include <span>

#include "core/llc.h"
#include "core/parallel.h"
#include "edgewise/backend.h"
#include "raster/binning/bins.h"
#include "raster/tile_task.h"
#include "raster/write_out_choice.h"

namespace edgewise {

// What a backend keeps from frame to frame.
struct TileScratch {
  Bins bins;
  WriteOutChoice write_out{llc_bytes()};
};

inline void draw_in_tiles(std::span<const ScreenTriangle> triangles, FrameView frame,
                          std::uint32_t background, const Execution& execution, int tile_size,
                          TileScratch& scratch, Bins::Small small, TileKernel draw_tile) {
  const int size_log2 = std::countr_zero(static_cast<unsigned>(tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2};
  const SimdTarget binning = execution.ideas.vector_setup ? execution.target : SimdTarget::scalar;
  Bins& bins = scratch.bins;
  bins.build(triangles, grid, execution.threads, binning, small, execution.ideas.prefetch);
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
  // Without vectors both ways are one.
  const bool open =
      execution.ideas.write_out == WriteOut::automatic && execution.target != SimdTarget::scalar;
  WriteOutChoice* const choice = open ? &scratch.write_out : nullptr;
  if (choice) choice->begin_frame({frame_bytes, triangles.size_bytes(), grid.cells(), execution.threads});
  const int columns = grid.columns();
  parallel_for(execution.threads, grid.cells(), [&](int cell) {
    TileTask job{triangles.data(),
                 &bins,
                 cell,
                 cell % columns << size_log2,
                 cell / columns << size_log2,
                 size_log2,
                 frame,
                 background,
                 execution.ideas};
    if (choice) {
      const WriteOutChoice::ForTile chosen = choice->for_tile(cell, bins.empty(cell));
      job.ideas.write_out = chosen.way, job.write_out_ns = chosen.elapsed_ns;
    }
    draw_tile(job);
  });
  if (choice) choice->end_frame();
}

}  // namespace edgewise

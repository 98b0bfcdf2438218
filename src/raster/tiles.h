// Drawing tile by tile, for backends that have a kernel for one tile: triangles are binned to tiles, and
// tiles are drawn in parallel.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/llc.h"
#include "core/parallel.h"
#include "core/triangle_source.h"
#include "edgewise/backend.h"
#include "raster/bands.h"
#include "raster/binning/bins.h"
#include "raster/tile_list.h"
#include "raster/tile_options.h"
#include "raster/tile_task.h"

namespace edgewise {

// How many triangles a tile has. Bins::few() defines `few`.
enum class TileContent { nothing, few, many };

// TileStore::automatic:
// - A frame larger than half the LLC is streamed: it cannot stay there beside its reader's data.
// - Empty tiles of other frames get cached stores, since no work overlaps with filling them.
// - If the triangles exceed an L2 cache, they need the LLC, and a tile with triangles is streamed.
// - On one thread, a tile with many triangles is streamed while the next one is drawn. Several threads that
//   stream would wait for the memory's bandwidth.
// - Other tiles get cached stores, and so do all tiles that are drawn over what the frame holds: they have
//   just been loaded.
// `triangles`: the inputs of the source, which for Backend::draw() are screen triangles.
constexpr TileStore tile_store_for(TileContent content, std::size_t triangles, int threads,
                                   std::size_t frame_bytes, std::size_t llc) {
  const bool fits_llc = frame_bytes <= llc / 2, fits_l2 = triangles * sizeof(ScreenTriangle) <= kL2Bytes;
  const bool cached =
      content == TileContent::nothing || (fits_l2 && (content == TileContent::few || threads > 1));
  return fits_llc && cached ? TileStore::cached : TileStore::streaming;
}

// A thread takes up to four consecutive tasks at once, since taking work costs oneTBB about 0.1 us.
constexpr int tasks_at_once(int tasks, int threads) {
  return std::clamp(tasks / (16 * threads), 1, 4);
}

// A tile is light if it has no more triangles than this, no masks, and is not cut by the frame's right side.
// Light tiles are cleared together with the empty ones of their row and drawn in the frame, which is faster
// than storing a buffer in short rows. More triangles overlap more, and drawing over pixels is slower in the
// frame than in a buffer in L1.
inline constexpr std::uint32_t kLightTriangles = 2;
static_assert(kLongestVector <= 16);  // px, of the smallest tile

// `draw_light` draws light tiles. If it is null, or tiles with few triangles are streamed, or the frame has
// no payload plane, no tile is light. Returns false if Bins::build() does; then nothing is drawn.
template <typename DrawTile>
bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, DrawTile&& draw_tile,
                   BandKernel draw_light = nullptr) {
  const FrameView& frame = part.frame;
  const int size_log2 = std::countr_zero(static_cast<unsigned>(execution.tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2, part.x0, part.y0};
  Bins& bins = scratch.bins;
  TileList& list = scratch.list;
  const Bins::Small small = options.coverage_masks ? Bins::Small::as_masks : Bins::Small::as_indices;
  if (!bins.build(triangles, grid, execution.threads, execution.target, small)) return false;
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
  const auto streamed = [&](TileContent content) {
    TileStore store = options.tile_store;
    if (store == TileStore::automatic)
      store = part.clear
                  ? tile_store_for(content, triangles.size(), execution.threads, frame_bytes, llc_bytes())
                  : TileStore::cached;
    return store == TileStore::streaming;
  };
  const bool stream_empty = streamed(TileContent::nothing), stream_few = streamed(TileContent::few),
             stream_many = streamed(TileContent::many);
  const ClearKernel clear = clear_kernel(execution.target);
  const int columns = grid.columns();
  const bool any_light = draw_light != nullptr && !stream_few && frame.payload != nullptr;
  // A tile that the frame's right side cuts may be narrower than a vector.
  list.build(bins, grid, part, execution.threads, [&](int cell) {
    return any_light && bins.few(cell, kLightTriangles) && ((cell % columns + 1) << size_log2) <= frame.width;
  });
  const std::span<const TileList::Task> tasks = list.tasks();
  const auto do_task = [&](int i) {
    const TileList::Task& task = tasks[static_cast<std::size_t>(i)];
    if (task.cell == TileList::kClearTiles) {
      if (part.clear) clear({list.tiles_to_clear(task.row), task.y0, task.y1, size_log2, part, stream_empty});
      for (const int cell : list.light_tiles(task.row)) {
        const int x0 = cell % columns << size_log2, x1 = x0 + (1 << size_log2);
        draw_light({bins, cell, {std::max(x0, part.x0), task.y0, x1, task.y1}, frame});
      }
      return;
    }
    const bool streaming = stream_few != stream_many && bins.few(task.cell) ? stream_few : stream_many;
    draw_tile(TileTask{bins.triangles(), &bins, task.cell, task.cell % columns << size_log2,
                       task.row << size_log2, size_log2, part, options.hierarchical_depth, streaming});
  };
  const int count = static_cast<int>(tasks.size());
  const int at_once = tasks_at_once(count, execution.threads);
  parallel_for(execution.threads, (count + at_once - 1) / at_once, [&](int i) {
    for (int k = i * at_once; k < std::min(count, (i + 1) * at_once); ++k) do_task(k);
  });
  return true;
}

// A backend that draws tile by tile overrides draw_source().
class TileBackend : public Backend {
 public:
  explicit TileBackend(const TileOptions& options) : options_(options) {}

 protected:
  const TileOptions options_;
  TileScratch scratch_;

 private:
  bool draws_depth_only() const final { return true; }
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override = 0;
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) final {
    StoredTriangles stored(triangles);
    draw_source(stored, part, execution);  // always true: stored triangles are not copied
  }
};

}  // namespace edgewise

#include "raster/tiles.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

#include "core/parallel.h"
#include "raster/clear.h"
#include "raster/llc.h"
#include "raster/policy.h"

namespace edgewise {

namespace {

// Which tiles get streaming stores.
struct Streaming {
  bool nothing, few, many;  // by the tile's content

  Streaming(const FramePart& part, const TileOptions& options, std::size_t read_bytes, int threads) {
    const FrameView& frame = part.frame;
    const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
    const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
    const auto streamed = [&](TileContent content) {
      TileStore store = options.tile_store;
      if (store == TileStore::automatic)
        store = part.clear ? tile_store_for(content, read_bytes, threads, frame_bytes, llc_bytes())
                           : TileStore::cached;
      return store == TileStore::streaming;
    };
    nothing = streamed(TileContent::nothing);
    few = streamed(TileContent::few), many = streamed(TileContent::many);
  }
};

}  // namespace

bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, TileKernel draw_tile,
                   FrameKernel draw_light) {
  const FrameView& frame = part.frame;
  const int size_log2 = std::countr_zero(static_cast<unsigned>(execution.tile_size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2, part.x0, part.y0};
  Bins& bins = scratch.bins;
  TileList& list = scratch.list;
  const Bins::Small small = options.coverage_masks ? Bins::Small::as_masks : Bins::Small::as_indices;
  if (!bins.build(triangles, grid, execution.threads, execution.target, small)) return false;
  const Streaming stream(part, options, bins.read_bytes(), execution.threads);
  const int columns = grid.columns();
  const bool any_light = draw_light != nullptr && !stream.few && frame.payload != nullptr;
  // A tile that the frame's right side cuts may be narrower than a vector.
  list.build(bins, grid, part, execution.threads, [&](int cell) {
    return any_light && bins.few(cell, kLightTriangles) && ((cell % columns + 1) << size_log2) <= frame.width;
  });
  const ClearKernel clear = clear_kernel(execution.target);
  const std::span<const TileList::Task> tasks = list.tasks();
  const auto do_task = [&](const TileList::Task& task) {
    if (task.cell == TileList::kClearTiles) {
      if (part.clear) clear({list.columns_to_clear(task.row), task.y0, task.y1, part, stream.nothing});
      for (const int cell : list.light_tiles(task.row)) {
        const int x0 = cell % columns << size_log2, x1 = x0 + (1 << size_log2);
        draw_light({bins, cell, {std::max(x0, part.x0), task.y0, x1, task.y1}, frame});
      }
      return;
    }
    const bool streaming = stream.few != stream.many && bins.few(task.cell) ? stream.few : stream.many;
    draw_tile({bins.triangles(), &bins, task.cell, task.cell % columns << size_log2, task.row << size_log2,
               size_log2, part, options.hierarchical_depth, streaming});
  };
  const int count = static_cast<int>(tasks.size());
  const int at_once = tasks_at_once(count, execution.threads);
  parallel_for(execution.threads, (count + at_once - 1) / at_once, [&](int i) {
    for (int k = i * at_once; k < std::min(count, (i + 1) * at_once); ++k)
      do_task(tasks[static_cast<std::size_t>(k)]);
  });
  return true;
}

namespace {

class Tiles final : public Backend {
 public:
  Tiles(TileKernel (*fill)(SimdTarget), const TileOptions& options) : fill_(fill), options_(options) {}

 private:
  bool draws_depth_only() const override { return true; }
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override {
    return draw_in_tiles(triangles, part, execution, options_, scratch_, fill_(execution.target),
                         options_.light_tiles ? frame_spans(execution.target) : nullptr);
  }
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    StoredTriangles stored(triangles);
    draw_source(stored, part, execution);  // always true: stored triangles are not copied
  }

  TileKernel (*const fill_)(SimdTarget);
  const TileOptions options_;
  TileScratch scratch_;
};

}  // namespace

std::unique_ptr<Backend> make_tiles(TileKernel (*fill)(SimdTarget), const TileOptions& options) {
  return std::make_unique<Tiles>(fill, options);
}

}  // namespace edgewise

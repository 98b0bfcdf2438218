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

void list_tasks(const Bins& bins, const CellGrid& grid, const FramePart& part, int threads,
                std::vector<TilesTask>& tasks) {
  constexpr int kLeastRows = 8;  // px, of a task that clears
  const int columns = grid.columns(), rows = grid.rows(), side = 1 << grid.cell_h_log2;
  const int most_strips = std::clamp(4 * threads / rows, 1, side / kLeastRows);
  tasks.clear();
  // For any frame of this size, so that later ones allocate nothing.
  tasks.reserve(static_cast<std::size_t>((columns + most_strips) * rows));
  for (int row = part.y0 / side; row < rows; ++row) {
    const int y0 = std::max(row * side, part.y0), height = std::min((row + 1) * side, grid.height) - y0;
    bool any_cleared = false;
    for (int column = part.x0 / side; column < columns; ++column) {
      const int cell = row * columns + column;
      if (bins.empty(cell))
        any_cleared = part.clear;
      else
        tasks.push_back({cell, row, y0, y0 + height});
    }
    const int strips = any_cleared ? std::clamp(height / kLeastRows, 1, most_strips) : 0;
    for (int i = 0; i < strips; ++i)
      tasks.push_back(
          {TilesTask::kClearEmpty, row, y0 + height * i / strips, y0 + height * (i + 1) / strips});
  }
}

namespace {

void clear_empty(const TilesTask& task, const Bins& bins, const CellGrid& grid, const FramePart& part,
                 bool streaming, ClearKernel clear) {
  constexpr int kLeastSide = 16;
  Interval intervals[contract::kMaxImageSide / kLeastSide / 2 + 1];  // of consecutive tiles
  std::size_t count = 0;
  const int first_cell = task.row * grid.columns(), side = 1 << grid.cell_w_log2;
  for (int x = part.x0 & -side; x < grid.width; x += side) {
    if (!bins.empty(first_cell + (x >> grid.cell_w_log2))) continue;
    if (count == 0 || intervals[count - 1].end != x) intervals[count++].begin = x;
    intervals[count - 1].end = x + side;
  }
  clear({std::span(intervals).first(count), task.y0, task.y1, part, streaming});
}

}  // namespace

bool draw_in_tiles(TriangleSource& triangles, const FramePart& part, const Execution& execution,
                   const TileOptions& options, TileScratch& scratch, TileKernel fill) {
  const auto& [threads, size, target] = execution;
  const FrameView& frame = part.frame;
  const int size_log2 = std::countr_zero(static_cast<unsigned>(size));
  const CellGrid grid{frame.width, frame.height, size_log2, size_log2, part.x0, part.y0};
  Bins& bins = scratch.bins;
  if (!bins.build(triangles, grid, threads, target, options.coverage_masks)) return false;
  list_tasks(bins, grid, part, threads, scratch.tasks);
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
  const auto is_streamed = [&](bool if_automatic) {
    return options.tile_store == TileStore::automatic ? if_automatic
                                                      : options.tile_store == TileStore::streaming;
  };
  const bool stream_tiles = is_streamed(tiles_are_streamed(part.clear)),
             stream_clears = is_streamed(clears_are_streamed(frame_bytes, llc_bytes()));
  const ClearKernel clear = clear_kernel(target);
  parallel_for(threads, static_cast<int>(scratch.tasks.size()), [&](int i) {
    const TilesTask& task = scratch.tasks[static_cast<std::size_t>(i)];
    if (task.cell == TilesTask::kClearEmpty)
      clear_empty(task, bins, grid, part, stream_clears, clear);
    else
      fill({bins.triangles(), &bins, task.cell, task.cell % grid.columns() << size_log2,
            task.row << size_log2, size_log2, part, options.hierarchical_depth, stream_tiles});
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
    return draw_in_tiles(triangles, part, execution, options_, scratch_, fill_(execution.target));
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

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>

#include "core/execution.h"
#include "core/parallel.h"
#include "core/triangle_source.h"
#include "raster/clear.h"
#include "raster/llc.h"
#include "raster/policy.h"
#include "raster/traversals.h"

namespace edgewise {

namespace {

// Call it for tiles that are not empty. A tile that the frame's right side cuts may be narrower than a
// vector.
bool is_light(const Bins& bins, const CellGrid& grid, int cell) {
  return bins.few(cell, kLightTriangles) && ((cell % grid.columns() + 1) << grid.cell_w_log2) <= grid.width;
}

// What clears the empty and light tiles of a part and draws the light ones.
struct InFrame {
  const Bins& bins;
  const CellGrid& grid;
  const FramePart& part;
  const bool streaming;
  const ClearKernel clear;
  const FrameKernel draw_light;  // null: no tile is light

  void operator()(const TileJob& job) const {
    Interval intervals[contract::kMaxImageSide / kLeastTileSize / 2 + 1];  // of tiles; clears clip them
    std::size_t count = 0;
    const int side = 1 << grid.cell_w_log2;
    const auto for_each_tile = [&](auto&& visit) {  // visit(its first column, its cell, whether it is empty)
      for (int x = part.x0 & -side; x < grid.width; x += side) {
        const int cell = job.row * grid.columns() + (x >> grid.cell_w_log2);
        const bool is_empty = bins.empty(cell);
        if (is_empty || (draw_light != nullptr && is_light(bins, grid, cell))) visit(x, cell, is_empty);
      }
    };
    for_each_tile([&](int x, int, bool) {
      if (count == 0 || intervals[count - 1].end != x) intervals[count++].begin = x;
      intervals[count - 1].end = x + side;
    });
    if (part.clear) clear({std::span(intervals).first(count), job.y0, job.y1, part, streaming});
    if (draw_light == nullptr) return;
    for_each_tile([&](int x, int cell, bool is_empty) {
      if (!is_empty) draw_light({bins, cell, {std::max(x, part.x0), job.y0, x + side, job.y1}, part.frame});
    });
  }
};

}  // namespace

void list_jobs(const Bins& bins, const CellGrid& grid, const FramePart& part, int threads, bool with_light,
               std::vector<TileJob>& jobs) {
  constexpr int kLeastRows = 8;  // px, of a job in the frame
  const int columns = grid.columns(), rows = grid.rows(), side = 1 << grid.cell_h_log2;
  const int most_strips = std::clamp(4 * threads / rows, 1, side / kLeastRows);
  jobs.clear();
  // For any frame of this size, so that later ones allocate nothing.
  jobs.reserve(static_cast<std::size_t>((columns + most_strips) * rows));
  for (int row = part.y0 / side; row < rows; ++row) {
    const int y0 = std::max(row * side, part.y0), height = std::min((row + 1) * side, grid.height) - y0;
    bool any_in_frame = false;
    for (int column = part.x0 / side; column < columns; ++column) {
      const int cell = row * columns + column;
      const bool is_empty = bins.empty(cell);
      if (is_empty || (with_light && is_light(bins, grid, cell)))
        any_in_frame |= part.clear || !is_empty;
      else
        jobs.push_back({cell, row, y0, y0 + height});
    }
    const int strips = any_in_frame ? std::clamp(height / kLeastRows, 1, most_strips) : 0;
    for (int i = 0; i < strips; ++i)
      jobs.push_back({TileJob::kInFrame, row, y0 + height * i / strips, y0 + height * (i + 1) / strips});
  }
}

namespace {

class Tiles final : public Backend {
 public:
  Tiles(std::function<TileKernel(SimdTarget)> fill, const TileOptions& options,
        FrameKernel (*light)(SimdTarget))
      : fill_(std::move(fill)), light_(light), options_(options) {}

 private:
  bool draws_depth_only() const override { return true; }
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override {
    const auto& [threads, tile_size, target] = execution;
    const FrameView& frame = part.frame;
    const int size_log2 = std::countr_zero(static_cast<unsigned>(tile_size));
    const CellGrid grid{frame.width, frame.height, size_log2, size_log2, part.x0, part.y0};
    if (!bins_.build(triangles, grid, threads, target, options_.coverage_masks)) return false;
    const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
    const std::size_t frame_bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload));
    const bool large = part.clear && is_large(frame_bytes, llc_bytes());
    const bool stream_tiles = streaming_or(part.clear && tiles_are_streamed(large, threads)),
               stream_clears = streaming_or(large);
    const bool with_light = light_ != nullptr && !stream_clears && frame.payload != nullptr;
    list_jobs(bins_, grid, part, threads, with_light, jobs_);
    const InFrame draw_in_frame{
        bins_, grid, part, stream_clears, clear_kernel(target), with_light ? light_(target) : nullptr};
    const TileKernel fill = fill_(target);
    parallel_for(threads, static_cast<int>(jobs_.size()), [&](int i) {
      const TileJob& job = jobs_[static_cast<std::size_t>(i)];
      if (job.cell == TileJob::kInFrame)
        draw_in_frame(job);
      else
        fill({bins_, job.cell, job.cell % grid.columns() << size_log2, job.row << size_log2, size_log2, part,
              options_.hierarchical_depth, stream_tiles});
    });
    return true;
  }
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    StoredTriangles stored(triangles);
    draw_source(stored, part, execution);  // always true: stored triangles need no room
  }
  bool streaming_or(bool automatic) const {
    return options_.tile_store == TileStore::automatic ? automatic
                                                       : options_.tile_store == TileStore::streaming;
  }

  const std::function<TileKernel(SimdTarget)> fill_;
  FrameKernel (*const light_)(SimdTarget);
  const TileOptions options_;
  Bins bins_;
  std::vector<TileJob> jobs_;
};

}  // namespace

std::unique_ptr<Backend> tile_backend(std::function<TileKernel(SimdTarget)> fill, const TileOptions& options,
                                      FrameKernel (*light)(SimdTarget)) {
  return std::make_unique<Tiles>(std::move(fill), options, light);
}

}  // namespace edgewise

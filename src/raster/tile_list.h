// The tasks of drawing a part of a frame in tiles. A row of tiles has a task for each tile drawn in a buffer,
// and then one, or several on many threads, that clears its empty and light tiles together and draws the
// light ones in the frame. If nothing is cleared, an empty tile has no task. oneTBB gets up to four of these
// tasks at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/backend.h"
#include "raster/binning/bins.h"
#include "raster/clear.h"

namespace edgewise {

class TileList {
 public:
  struct Task {
    int cell;    // in the bins; kClearTiles: the pixel rows y0 … y1 - 1 of a row's empty and light tiles
    int row;     // of tiles
    int y0, y1;  // px, in the part
  };
  static constexpr int kClearTiles = -1;

  // `grid`: of the part's frame. is_light(cell): whether a tile with triangles is light.
  template <typename IsLight>
  void build(const Bins& bins, const CellGrid& grid, const FramePart& part, int threads, IsLight&& is_light) {
    const int columns = grid.columns(), rows = grid.rows(), side = 1 << grid.cell_h_log2;
    const int most_strips = std::clamp(4 * threads / rows, 1, side / kLeastRows);
    tasks_.clear(), clear_.clear(), row_begin_.clear(), light_.clear(), light_begin_.clear();
    // For any frame of this size, so that later ones allocate nothing.
    tasks_.reserve(static_cast<std::size_t>((columns + most_strips) * rows));
    clear_.reserve(static_cast<std::size_t>((columns + 1) / 2 * rows));
    light_.reserve(static_cast<std::size_t>(columns * rows));
    row_begin_.reserve(static_cast<std::size_t>(rows) + 1);
    light_begin_.reserve(static_cast<std::size_t>(rows) + 1);
    for (int row = 0; row < rows; ++row) {
      const int y0 = std::max(row * side, part.y0), height = std::min((row + 1) * side, grid.height) - y0;
      row_begin_.push_back(clear_.size());
      light_begin_.push_back(light_.size());
      if (height <= 0) continue;  // above the part
      bool after_cleared = false;
      for (int column = part.x0 >> grid.cell_w_log2; column < columns; ++column) {
        const int cell = row * columns + column;
        const bool is_empty = bins.empty(cell), in_buffer = !is_empty && !is_light(cell);
        const bool is_cleared = !in_buffer && (part.clear || !is_empty);
        if (in_buffer) tasks_.push_back({cell, row, y0, y0 + height});
        if (is_cleared && after_cleared)
          clear_.back().end += side;
        else if (is_cleared)
          clear_.push_back({column * side, (column + 1) * side});
        if (!in_buffer && !is_empty) light_.push_back(cell);
        after_cleared = is_cleared;
      }
      if (clear_.size() == row_begin_.back()) continue;
      const int strips = std::clamp(height / kLeastRows, 1, most_strips);
      for (int i = 0; i < strips; ++i)
        tasks_.push_back({kClearTiles, row, y0 + height * i / strips, y0 + height * (i + 1) / strips});
    }
    row_begin_.push_back(clear_.size());
    light_begin_.push_back(light_.size());
  }

  std::span<const Task> tasks() const { return tasks_; }
  // Those of the empty and the light tiles of a row of tiles, which may pass the frame's right side; if
  // nothing is cleared, only the light ones.
  std::span<const Interval> columns_to_clear(int row) const { return of_row(clear_, row_begin_, row); }
  // The cells of the light tiles of a row.
  std::span<const int> light_tiles(int row) const { return of_row(light_, light_begin_, row); }

 private:
  template <typename T>
  static std::span<const T> of_row(const std::vector<T>& all, const std::vector<std::size_t>& begin,
                                   int row) {
    const auto r = static_cast<std::size_t>(row);
    return std::span(all).subspan(begin[r], begin[r + 1] - begin[r]);
  }

  static constexpr int kLeastRows = 8;  // px, of a task that clears a part of a row's empty and light tiles
  std::vector<Task> tasks_;
  std::vector<Interval> clear_;
  std::vector<int> light_;
  // Index in clear_ and in light_ of each row's first; then their sizes.
  std::vector<std::size_t> row_begin_, light_begin_;
};

}  // namespace edgewise

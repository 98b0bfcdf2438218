// The tasks of drawing a frame in tiles. A row of tiles has a task for each tile with triangles, and then
// one, or several on many threads, for all its empty tiles. oneTBB gets up to four of these tasks at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/framebuffer.h"
#include "edgewise/simd_target.h"
#include "raster/binning/bins.h"

namespace edgewise {

// Tiles of one row, columns begin … end - 1.
struct TileSpan {
  int begin, end;
};

class TileList {
 public:
  struct Task {
    int cell;    // in the bins; kEmptyTiles: clear the pixel rows y0 … y1 - 1 of a row's empty tiles
    int row;     // of tiles
    int y0, y1;  // px
  };
  static constexpr int kEmptyTiles = -1;

  void build(const Bins& bins, const CellGrid& grid, int threads) {
    const int columns = grid.columns(), rows = grid.rows(), side = 1 << grid.cell_h_log2;
    const int most_strips = std::clamp(4 * threads / rows, 1, side / kLeastRows);
    tasks_.clear(), empty_.clear(), row_begin_.clear();
    // For any frame of this size, so that later ones allocate nothing.
    tasks_.reserve(static_cast<std::size_t>((columns + most_strips) * rows));
    empty_.reserve(static_cast<std::size_t>((columns + 1) / 2 * rows));
    row_begin_.reserve(static_cast<std::size_t>(rows) + 1);
    for (int row = 0, cell = 0; row < rows; ++row) {
      const int y0 = row * side, height = std::min(side, grid.height - y0);
      row_begin_.push_back(empty_.size());
      bool after_empty = false;
      for (int column = 0; column < columns; ++column, ++cell) {
        const bool is_empty = bins.empty(cell);
        if (!is_empty)
          tasks_.push_back({cell, row, y0, y0 + height});
        else if (after_empty)
          ++empty_.back().end;
        else
          empty_.push_back({column, column + 1});
        after_empty = is_empty;
      }
      if (empty_.size() == row_begin_.back()) continue;
      const int strips = std::clamp(height / kLeastRows, 1, most_strips);
      for (int i = 0; i < strips; ++i)
        tasks_.push_back({kEmptyTiles, row, y0 + height * i / strips, y0 + height * (i + 1) / strips});
    }
    row_begin_.push_back(empty_.size());
  }

  std::span<const Task> tasks() const { return tasks_; }
  std::span<const TileSpan> empty_tiles(int row) const {
    const auto r = static_cast<std::size_t>(row);
    return {empty_.data() + row_begin_[r], row_begin_[r + 1] - row_begin_[r]};
  }

 private:
  static constexpr int kLeastRows = 8;  // px, of a task that fills a part of a row's empty tiles
  std::vector<Task> tasks_;
  std::vector<TileSpan> empty_;
  std::vector<std::size_t> row_begin_;  // index in empty_ of each row's first span; then empty_.size()
};

// What drawing in tiles keeps between frames.
struct TileScratch {
  Bins bins;
  TileList list;
};

// Clears tiles without triangles, or a band. All those of a row are cleared together, pixel row by pixel row:
// long consecutive stores use the memory's bandwidth better than the short rows of one tile after the other.
struct ClearTask {
  std::span<const TileSpan> tiles;  // of one row
  int y0, y1;                       // the pixel rows y0 … y1 - 1
  int size_log2;                    // px, of a tile
  FrameView frame;
  std::uint32_t background;
  bool streaming;  // requested
};

using ClearKernel = void (*)(const ClearTask&);

// `target` must be resolved.
ClearKernel clear_kernel(SimdTarget target);

}  // namespace edgewise

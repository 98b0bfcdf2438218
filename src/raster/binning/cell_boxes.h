// Which cells of a grid the bounding boxes of triangles touch, and of few cells the triangles themselves, a
// vector of triangles at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "edgewise/contract.h"
#include "edgewise/screen_triangle.h"
#include "edgewise/simd_target.h"

namespace edgewise {

struct CellGrid {
  int width, height;             // px, the image
  int cell_w_log2, cell_h_log2;  // px
  int columns() const { return (width + (1 << cell_w_log2) - 1) >> cell_w_log2; }
  int rows() const { return (height + (1 << cell_h_log2) - 1) >> cell_h_log2; }
  int cells() const { return columns() * rows(); }
};

struct CellBox {
  std::uint16_t column0, row0, column1, row1;  // inclusive
};

inline constexpr int kBoxesAtOnce = 64;

struct CellBoxes {
  CellBox box[kBoxesAtOnce];
  // Where a box is at most 2 x 2 cells, those that the triangle may touch: bit column + 2 row. Or 0: they
  // have to be looked for.
  alignas(64) std::int32_t of_four[kBoxesAtOnce];

  // The box of triangle i, which may touch all cells of it.
  void set(std::size_t i, const contract::PixelBox& px, const CellGrid& grid) {
    const auto cell = [](int at, int log2) { return static_cast<std::uint16_t>(at >> log2); };
    const CellBox b = {cell(px.x0, grid.cell_w_log2), cell(px.y0, grid.cell_h_log2),
                       cell(px.x1 - 1, grid.cell_w_log2), cell(px.y1 - 1, grid.cell_h_log2)};
    const int columns = b.column1 - b.column0, rows = b.row1 - b.row0;  // less one
    box[i] = b;
    of_four[i] =
        std::max(columns, rows) > 1 ? 0 : (columns == 0 ? 0b01 : 0b11) * (rows == 0 ? 0b0001 : 0b0101);
  }
};

// Writes the boxes of kBoxesAtOnce triangles and returns which of them hold a sample, bit by bit; the others'
// boxes mean nothing. `prefetch`: the triangles that follow in memory are asked for.
using CellBoxKernel = std::uint64_t (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                                        CellBoxes& out);

// `target` must be resolved.
CellBoxKernel cell_box_kernel(SimdTarget target);

}  // namespace edgewise

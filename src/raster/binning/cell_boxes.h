// The cells of a grid that the bounding boxes of triangles overlap, and for boxes of up to 2 x 2 cells those
// that the triangle itself may cover, a vector of triangles at a time.
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
  int x0 = 0, y0 = 0;            // px, the first column and row that are drawn
  int columns() const { return (width + (1 << cell_w_log2) - 1) >> cell_w_log2; }
  int rows() const { return (height + (1 << cell_h_log2) - 1) >> cell_h_log2; }
  int cells() const { return columns() * rows(); }
  contract::PixelBox drawn() const { return {x0, y0, width, height}; }
};

struct CellBox {
  std::uint16_t column0, row0, column1, row1;  // inclusive
};

// Of a triangle's pixel_box(), the part that is drawn.
inline contract::PixelBox box_in(const CellGrid& grid, const ScreenTriangle& t) {
  contract::PixelBox box = contract::pixel_box(t, grid.width, grid.height);
  box.x0 = std::max(box.x0, grid.x0), box.y0 = std::max(box.y0, grid.y0);
  return box;
}

inline constexpr int kPacket = 64;

struct CellBoxes {
  CellBox box[kPacket];
  // For a box of at most 2 x 2 cells, the cells of which the triangle may cover a pixel: bit column + 2 row.
  // 0 for larger boxes.
  alignas(64) std::int32_t candidate_cells[kPacket];

  // Sets the box of triangle i. All its cells become candidates.
  void set(std::size_t i, const contract::PixelBox& px, const CellGrid& grid) {
    const auto cell = [](int at, int log2) { return static_cast<std::uint16_t>(at >> log2); };
    const CellBox b = {cell(px.x0, grid.cell_w_log2), cell(px.y0, grid.cell_h_log2),
                       cell(px.x1 - 1, grid.cell_w_log2), cell(px.y1 - 1, grid.cell_h_log2)};
    const int columns = b.column1 - b.column0, rows = b.row1 - b.row0;  // less one
    box[i] = b;
    candidate_cells[i] =
        std::max(columns, rows) > 1 ? 0 : (columns == 0 ? 0b01 : 0b11) * (rows == 0 ? 0b0001 : 0b0101);
  }
};

// Writes the boxes of kPacket triangles. Bit i of the result is set if the drawn part of triangle i's box
// holds a sample; the other boxes are unspecified. `prefetch`: prefetch the triangles that follow in memory.
using CellBoxKernel = std::uint64_t (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                                        CellBoxes& out);

// `target` must be resolved.
CellBoxKernel cell_box_kernel(SimdTarget target);

}  // namespace edgewise

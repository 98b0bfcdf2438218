// The grid of cells that binning sorts into, and the cells that a triangle's bounding box overlaps.
#pragma once

#include <cstdint>

#include "edgewise/contract.h"

namespace edgewise {

struct CellGrid {
  int width, height;             // px, where the drawn part of the image ends
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

}  // namespace edgewise

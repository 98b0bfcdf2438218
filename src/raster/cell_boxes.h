// Which cells of a grid the bounding boxes of triangles touch, a vector of triangles at a time.
#pragma once

#include <cstdint>

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

// Writes the boxes of kBoxesAtOnce triangles to out[0 … kBoxesAtOnce) and returns which of them hold a
// sample, bit by bit; the others' boxes mean nothing. `prefetch`: the triangles that follow in memory are
// asked for.
using CellBoxKernel = std::uint64_t (*)(const ScreenTriangle* triangles, const CellGrid& grid, bool prefetch,
                                        CellBox* out);

// `target` must be resolved.
CellBoxKernel cell_box_kernel(SimdTarget target);

}  // namespace edgewise

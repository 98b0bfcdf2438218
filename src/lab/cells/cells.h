// Exact ways to draw a frame that differ in one factor at a time: what scanlines, tiles, edge functions,
// SIMD, hierarchical depth and coverage masks each gain. All draw the backends' picture, bit for bit.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "edgewise/backend.h"

namespace edgewise::lab {

struct Cell {
  BackendInfo backend;
  std::string_view
      traversal;          // "bands": 32 rows at a time, in the frame itself; "tiles": 64 x 64 px in a buffer
  std::string_view fill;  // "spans" or "edges": how a triangle's pixels are found
  std::string_view with;  // "hiz" or "hiz+masks", more optimizations of tiles; "": none
  SimdTarget target;      // scalar or best
};

std::span<const Cell> cells();

// "traversal:tiles/fill:spans/simd:avx512/with:hiz"
std::string factors(const Cell& cell);

}  // namespace edgewise::lab

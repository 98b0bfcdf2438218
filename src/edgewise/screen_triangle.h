// What the front end hands to a backend: a triangle on the snapped pixel grid.
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>

namespace edgewise {

// Vertices in either winding; see contract.h for the ranges (rules 2, 3 and 6), which the front end
// guarantees and every backend relies on: who makes triangles by hand must keep to |x_sub|, |y_sub| <=
// contract::kGuardSub and contract::kDepthHead <= z <= contract::kDepthHead + contract::kDepthRange. A
// triangle of zero area draws nothing.
struct alignas(8) ScreenTriangle {
  std::int32_t x_sub[3];  // 1/256 px, x to the right
  std::int32_t y_sub[3];  // 1/256 px, y down
  std::uint32_t z[3];     // contract depth units (rule 6); smaller is nearer
  std::uint32_t payload;  // written where the triangle wins: a colour when rendering, an id when judging
};
static_assert(sizeof(ScreenTriangle) == 40);

}  // namespace edgewise

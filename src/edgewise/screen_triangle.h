// What the front end hands to a backend: triangles on the snapped pixel grid.
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <span>

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

// Triangles together with the image size they were made for. A backend refuses a frame of any other size. A
// plain span carries no size, so a backend draws it to any frame.
class ScreenTriangles : public std::span<const ScreenTriangle> {
 public:
  ScreenTriangles(std::span<const ScreenTriangle> triangles, int width, int height)
      : span(triangles), width_(width), height_(height) {}

  int width() const { return width_; }    // px
  int height() const { return height_; }  // px

 private:
  int width_, height_;
};

}  // namespace edgewise

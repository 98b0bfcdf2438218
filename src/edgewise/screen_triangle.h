// The triangles that the front end passes to a backend, with snapped vertices.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstdint>
#include <span>

#pragma GCC visibility push(default)
namespace edgewise {

// Either winding is allowed, and a triangle of zero area draws nothing. Backends rely on these ranges (rules
// 3 and 6 of contract.h) and do not check them:
//   |x_q15|, |y_q15| <= contract::kGuard_q15
//   contract::kDepthHead <= z <= contract::kDepthHead + contract::kDepthRange
// The front end keeps to them. If you make triangles by hand, you must keep to them too.
struct alignas(8) ScreenTriangle {
  std::int32_t x_q15[3];  // 2^-15 px, x to the right
  std::int32_t y_q15[3];  // 2^-15 px, y down
  std::uint32_t z[3];     // contract depth units (rule 6); smaller is nearer
  std::uint32_t payload;  // written where the triangle is visible: a colour or an id (Payload)
};
static_assert(sizeof(ScreenTriangle) == 40);

// Triangles and the image size they were made for. A backend throws if the frame has another size. A plain
// span carries no size and is not checked. The triangles are not owned.
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
#pragma GCC visibility pop

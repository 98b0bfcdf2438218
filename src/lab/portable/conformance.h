// What a conformant rasterizer may do, as a model with numbers. It allows more than any one of the
// specifications, so that two programs that follow any of them agree wherever the model leaves no choice.
//
// - One sample at the centre of each pixel. A sample inside a triangle is covered; for a sample on an edge,
// any
//   rule may decide. Direct3D 11.3 functional specification, 3.4.2; Vulkan 1.3, 28.12.1 "Basic Polygon
//   Rasterization"; WebGPU, "Polygon Rasterization".
// - Positions are rounded to at least `subpixel_bits` bits in any direction, so by less than one step.
// Direct3D
//   demands 8 bits (3.4.1); Vulkan's subPixelPrecisionBits is at least 4, and 8 on desktop GPUs.
// - Before that, the viewport transform in floats errs by up to `transform_ulps` of the largest coordinate.
//   Vulkan 1.3, 27.9 "Controlling the Viewport" gives the formula, not its precision.
// - Depth planes are evaluated in floats, from one corner of the image, and rounded to the format. A fragment
//   passes if it is nearer than the depth that is stored.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace edgewise::lab {

struct DepthFormat {
  std::string_view name;  // Vulkan's, in lower case
  double step;            // largest distance of two neighbouring values in [0, 1]
};
std::span<const DepthFormat> depth_formats();
// Throws std::invalid_argument with the nearest known name.
const DepthFormat& find_depth_format(std::string_view name);

struct Conformance {
  int subpixel_bits = 8;   // 1 … 16
  int transform_ulps = 2;  // 0 … 1000
  DepthFormat depth = find_depth_format("d24_unorm");
};

// An upper bound of the error of a depth plane in floats that is extrapolated from a corner of the image, in
// the unit of the depths. `largest_z` bounds the depths, `span_z` their differences. `dx_px` and `dy_px` are
// the absolute distances of vertices 1 and 2 from vertex 0, added up; the area is twice the triangle's, in
// px².
double float_plane_error(double largest_z, double span_z, double dx_px, double dy_px, double area_px,
                         int width, int height);

}  // namespace edgewise::lab

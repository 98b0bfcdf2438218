// Which pixels show the same triangle in every picture that a conformant rasterizer may draw.
//
// What a conformant rasterizer may do, as a model with numbers. It allows more than any one of the
// specifications, so that two programs that follow any of them agree wherever the model leaves no choice.
// Positions in clip space are taken as given: they are the application's.
//
// Sample: one at the centre of each pixel. A sample inside a triangle is covered. For a sample on an edge,
// any rule may decide. Direct3D 11.3 functional specification, 3.4.2; Vulkan 1.3, 28.12.1 "Basic Polygon
// Rasterization"; WebGPU, "Polygon Rasterization".
//
// Snapping: positions are rounded to at least `subpixel_bits` bits in any direction, so by less than one
// step. Direct3D demands 8 bits (3.4.1). Vulkan's subPixelPrecisionBits is at least 4, and 8 on desktop GPUs.
//
// Viewport: before that, the transform in floats errs by up to `transform_ulps` of the largest coordinate.
// Vulkan 1.3, 27.9 "Controlling the Viewport" gives the formula, not its precision.
//
// Clipping: a vertex where an edge meets the near or far plane is interpolated in floats, with an error of at
// most kClipError times the largest coordinates of the clipped triangle, which were rounded to float before.
// A triangle that only touches the plane from inside may be clipped or not. From outside, it covers no
// sample. The sides of the picture cut no triangle: rasterizers have a guard band around it. Of a triangle
// that reaches beyond the guard band, a rasterizer may leave out any sample: llvmpipe of Mesa 22.3 drops some
// that reach 3040 px beyond the left and the top side.
//
// Depth: vertex depths err by at most kVertexDepthError. Planes are evaluated in floats, from one corner of
// the image, for the rounded positions. Depths are rounded to the format. The buffer is cleared to 1, and a
// fragment passes if it is nearer than the depth that is stored. A reversed buffer of floats, cleared to 0,
// has no larger steps than d32_sfloat.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"

namespace edgewise::lab {

inline constexpr double kVertexDepthError = 0x1p-22;  // of a float z / w: a few units in the last place
inline constexpr double kClipError = 0x1p-20;         // sixteen roundings of floats, with the transform's

struct DepthFormat {
  std::string_view name;  // Vulkan's, in lower case
  double step;            // largest distance of two neighbouring values in [0, 1]
};
std::span<const DepthFormat> depth_formats();
// Throws std::invalid_argument with the nearest known name.
const DepthFormat& find_depth_format(std::string_view name);

struct Conformance {
  int subpixel_bits = 8;     // 1 … kMaxSubpixelBits; a judged picture of ours has at least as many
  int transform_ulps = 2;    // 0 … 1000
  int guard_band_px = 3000;  // beyond each side of the picture; 0 … 2^20
  DepthFormat depth = find_depth_format("d24_unorm");
};

// An upper bound of the error of a depth plane in floats, in the unit of the depths. `largest_z` bounds the
// depths, `span_z` their differences. `dx_px` and `dy_px` are the absolute distances of vertices 1 and 2 from
// vertex 0, added up. `reach_x_px` and `reach_y_px` bound the distances of vertices and samples from the
// corner of the image. `area_px` is twice the triangle's area, in px²; infinity if it is not positive.
double float_plane_error(double largest_z, double span_z, double dx_px, double dy_px, double area_px,
                         double reach_x_px, double reach_y_px);

// Why a pixel may show different triangles. The strongest reason counts, and the last is the strongest.
enum class Unstable : std::uint8_t {
  no,
  depth,  // two triangles cover the pixel in every case, but rounding decides which one is nearer
  edge,   // an edge passes so closely that rounding decides whether its triangle covers the sample
  tie,    // as `edge`, with the sample exactly on it
  clip    // as `edge`, of a triangle that the near or far plane cuts or touches; or any sample of one that
          // reaches beyond the guard band
};
inline constexpr int kUnstableKinds = 5;
std::string_view name_of(Unstable reason);  // "portable", "depth", "edge", "tie", "clip"

struct PortablePixels {
  int width, height;              // px
  std::vector<Unstable> reasons;  // row by row from the top

  std::array<std::uint64_t, kUnstableKinds> counts() const;
};

// The input: triangles before snapping, in submission order. Those with the same id count as one triangle.
struct PortableTriangle {
  UnsnappedTriangle at;
  std::uint32_t id;
  bool drawn;    // false: culled for its facing, which rounding may reverse
  bool clipped;  // a piece of a triangle that the near or far plane cuts or touches
  // How much further than the model's roundings the vertices may be off.
  double position_error_px = 0.0, depth_error = 0.0;
};

// Conservative: a pixel is `no` only if every choice that the model allows shows the same triangle, or the
// background. Depths must be finite, and coordinates within 2^20 px. Throws std::invalid_argument for a
// coordinate, a size or a model out of range.
PortablePixels portable_pixels(std::span<const PortableTriangle> triangles, int width, int height,
                               const Conformance& model, int threads);

// The triangles of a drawable. `options` are those of the picture that is drawn.
std::vector<PortableTriangle> portable_triangles(const Drawable& drawable, FrontendOptions options);

}  // namespace edgewise::lab

// Barycentric coordinates and distances of a frame's pixels, from which a caller can interpolate attributes:
// colours, normals, texture coordinates, positions.
//
// Pixel (0, 0) is top left, its centre lies at (0.5, 0.5), and y points down. The smaller depth is nearer.
// The front of a triangle is the side whose vertices appear clockwise (camera.h).
#pragma once

#include "edgewise/cxx20.h"

#include <cstddef>

#include "edgewise/framebuffer.h"
#include "edgewise/frontend.h"
#include "edgewise/scene.h"

#pragma GCC visibility push(default)
namespace edgewise {

// What barycentrics() writes, in the caller's memory. Row 0 is the top. Strides count floats from row to row.
// A plane that is null is not written.
struct BarycentricsView {
  float* uv;                  // pixel (x, y): u at uv[y * uv_stride + 2 * x], then v; background: 0, 0
  std::ptrdiff_t uv_stride;   // at least 2 * width
  float* distance = nullptr;  // pixel (x, y): at distance[y * distance_stride + x]; background: infinity
  std::ptrdiff_t distance_stride = 0;  // at least width
};

// For each pixel, finds the point of the visible triangle that its sample shows. u and v are that point's
// perspective-correct coordinates (rule 11): with the values a0, a1, a2 of an attribute at the triangle's
// vertices, in the order of Mesh::triangles or StreamTriangle::vertex, the pixel's value is
//   (1 - u - v) a0 + u a1 + v a2
// u and v are multiples of 2^-24. u, v and 1 - u - v, which is exact in float, are >= 0. `distance` is along
// the camera's view direction in world units; with matrices, it is w. In a stream, and in a parallel
// projection, where w is the same everywhere, it is the depth in [0, 1].
//
// With e, a bound of the relative error of w at the triangle's vertices, the error of u and v is below
// contract::kBarycentricError + e / 2, and the relative error of the distance (the absolute one of a depth)
// below contract::kDistanceError + e. In a stream, e is 0. In a scene seen by a Camera, e is kWError D / w,
// 2^-20 D / w, where D is the vertex's distance from the camera, and w that along the view direction: D / w
// is 1 to 2 in usual views. Rule 11 has e for matrices, scaled instances and clipped triangles.
//
// `ids` is a frame of `drawable` alone, drawn with `options`, where payload is Payload::id. A pixel is
// background if its depth is contract::kDepthClear; other depths do not count. So if the frame shows several
// draws, pass a copy of its depths in which the pixels of the others are background. Each thread
// keeps less than 1 MB until the call ends. A pixel costs three edge functions, nine products and three
// divisions, in doubles. A visible triangle is also transformed again, once or a few times; with triangles of
// a few pixels, this costs more.
//
// Throws std::invalid_argument
// - for planes that cannot be read or written, or that overlap in memory, for options of another size than
//   the frame or another payload than ids, for a camera, an instance's mesh index or matrix, a number of
//   triangles, a first id or an execution that Frontend::run() throws for, and for flags that are neither
//   empty nor one per triangle. Then nothing has been written.
// - if a pixel has an id that the drawable lacks, or that of a triangle that does not cover the pixel: the
//   frame shows something else. Then the content of the planes is undefined, as it is after std::bad_alloc.
void barycentrics(const ConstFrameView& ids, const Drawable& drawable, const FrontendOptions& options,
                  const BarycentricsView& out, const Execution& execution = {});

}  // namespace edgewise
#pragma GCC visibility pop

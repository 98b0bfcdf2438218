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
// draws, pass a copy of its depths in which the pixels of the others are background. Each thread keeps less
// than 1 MB until the call ends. A pixel costs three edge functions, nine products and three divisions, in
// doubles. A visible triangle is also transformed again, once or a few times; with triangles of a few pixels,
// this costs more.
//
// Throws std::invalid_argument
// - for planes that cannot be read or written, or that overlap in memory, for options of another size than
//   the frame or another payload than ids, for a camera, a number of subpixel bits, an instance's mesh index
//   or matrix, a number of triangles, a first id or an execution that Frontend::run() throws for, and for
//   flags that are neither empty nor one per triangle. Then nothing has been written.
// - if a pixel has an id that the drawable lacks, or that of a triangle that does not cover the pixel: the
//   frame shows something else. Then the content of the planes is undefined, as it is after std::bad_alloc.
void barycentrics(const ConstFrameView& ids, const Drawable& drawable, const FrontendOptions& options,
                  const BarycentricsView& out, const Execution& execution = {});

namespace contract {

// Rule 11 of the contract, barycentric coordinates. They are perspective-correct for the snapped
// triangle. Let E_i be the unbiased edge value (rule 4) opposite vertex i at a sample that the triangle
// covers: an integer >= 0. Let w_i > 0 be the w of that vertex, and s_ik the weight of the source triangle's
// vertex k in it. Then the weight of the source triangle's vertex k at the sample is
//   c_k / (c_0 + c_1 + c_2),  c_k = E_0 s_0k / w_0 + E_1 s_1k / w_1 + E_2 s_2k / w_2
// which is u for k = 1 and v for k = 2. In a stream, w is 1. In a scene, w is the float by which x and y were
// divided (rule 10), or a double for a vertex that the clipper placed. A vertex of the source triangle has
// weight 1 of itself. A new vertex lies at t between two others, where t in [0, 1] is the double by which the
// clipper interpolates: its weights are those of the two, times 1 - t and t. If several pieces of a source
// triangle cover the sample, the first one counts.
//
// All terms are >= 0, so relative errors only add up. In units of 2^-53:
//   s_ik: 1 - t, product and sum, for each of six planes           18
//   c_k: quotient by w, product with E, two sums                   22
//   u and v: 22, and 24 of the sum of the three, and the quotient  47
// u is then rounded to a multiple of 2^-24, half to even. v is too, but to 1 - u at most. The exact sum of
// the two is at most 1, so v is then off by no more than u is: |error of u, v| < 2^-25 + 2^-47. Floats hold
// u, v, u + v <= 1 and 1 - u - v exactly.
//
// The distance along the view direction is
//   (E_0 + E_1 + E_2) / (c_0 + c_1 + c_2)
// Its relative error is below 4 + 24 + 1 units, and 2^-24 for the rounding to float. In a stream, and in a
// parallel projection, each E_i is multiplied by the depth of vertex i, which is in [0, 1], and divided by
// w_i.
//
// In a scene, w_i is rounded. With a relative error of w of at most e, each c_k errs by up to e:
// - u changes by u (1 - u) 2 e / (1 - e) at most, and the distance by e / (1 - e).
// - Let D be the vertex's distance from o (rule 10), and Lw the length of w's coefficients: 1 for a Camera
//   and an unscaled instance.
// - In units of 2^-24, the first three terms of w are rounded six times. They are at most Lw times the length
//   of d, which is at most 2 D. The fourth is rounded twice and is at most Lw D.
// - The sum is 14 Lw D. So e / (1 - e) < 2^-20 Lw D / w while e < 1/16, and while o is at most 2^24 D away
//   from the model's origin (rule 10).
// - Other projections than the usual perspective add 2^-23: their fourth term is w at o larger.
// - A vertex that the clipper placed has e < 2^-48 Lw D / w, with the D of the farthest corner.
// So, for the largest D / w of the piece's vertices,
//   |error of u, v| < 2^-25 + 2^-47 + 2^-21 Lw D / w
//   |relative error of the distance| < 2^-24 + 2^-48 + 2^-20 Lw D / w
inline constexpr double kWError = 0x1p-20;                      // relative, times Lw D / w
inline constexpr double kBarycentricError = 0x1p-25 + 0x1p-47;  // absolute
inline constexpr double kDistanceError = 0x1p-24 + 0x1p-48;     // relative, of distances from 2^-126 on

}  // namespace contract

}  // namespace edgewise
#pragma GCC visibility pop

// The table of coverage methods: one entry each. What a method computes, its cover(), is in float_edges.h,
// fixed_edges.h or dda.h; edges-inl.h has what differs in lanes. This file compiles every cover() for
// DepthPlot, and once per SIMD target for LanePlot.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/coverage/methods.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/kernel_table.h"
#include "lab/coverage/dda.h"
#include "lab/coverage/edges-inl.h"
#include "lab/coverage/lane_plot-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise::lab {
namespace HWY_NAMESPACE {

// Flattened, so that the code of a method, which is written once for all targets, is compiled for this one.
template <class Method>
HWY_FLATTEN void draw(const CoverageInput& input, Canvas& canvas) {
  draw_with<Method, LanePlot>(input, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise::lab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise::lab {

namespace {

// A method with a SIMD form.
template <class Method>
CoverageMethod method(const MethodInfo& info, const CoveragePromise& promise) {
  return make_coverage_method<Method>(
      info, promise, [](SimdTarget target) -> DrawForm { return EDGEWISE_KERNEL(draw<Method>, target); });
}

constexpr CoveragePromise watertight(int snap_bits) {
  return {
      .reach_px = snap_reach_px(snap_bits), .no_gaps = true, .no_double_hits = true, .snap_bits = snap_bits};
}
// While the triangle's box has at most max_side_px per side, its area in square units is below 2^31, and no
// value at a sample in the box is larger: none wraps. With one px more it is above.
constexpr CoveragePromise watertight_up_to(int max_side_px, int snap_bits) {
  CoveragePromise promise = watertight(snap_bits);
  promise.max_side_px = max_side_px;
  return promise;
}

}  // namespace

std::vector<CoverageMethod> coverage_table() {
  return {
      // Samples on a shared edge are drawn twice.
      method<FloatLe>(
          {"float_le", "float inside test that accepts all edges (<= 0)",
           "the Pico-8 engine's \"inside test\"",
           "wrong only within 0.0028 px of an edge; no gaps if all vertices lie on the 1/256 px grid", false},
          {.reach_px = kFloatReachPx, .no_gaps = true, .if_on_grid = true}),
      // Samples on a shared edge are not drawn.
      method<FloatLt>(
          {"float_lt", "float inside test that rejects all edges (< 0)", "the Pico-8 engine's \"culling\"",
           "wrong only within 0.0028 px of an edge; no double hits if all vertices lie on the 1/256 px grid",
           false},
          {.reach_px = kFloatReachPx, .no_double_hits = true, .if_on_grid = true}),
      // The right tie rule on rounded values. Two neighbours evaluate their shared edge from different ends,
      // so their rounding errors may differ.
      method<FloatTopLeft>(
          {"float_top_left", "float edge functions with the top-left rule, vertices not snapped",
           "Scratchapixel, \"Rasterization: a Practical Implementation\"",
           "wrong only within 0.0028 px of an edge", false},
          {.reach_px = kFloatReachPx}),
      // C = x y' - x' y. Its products grow with the distance from the image's corner, and their rounding
      // errors with them.
      method<EdgeEquations<false>>(
          {"float_equation", "float edge equations A x + B y + C with the top-left rule",
           "Olano and Greer 1997, with w = 1", "wrong only within 1.5 px of an edge", false},
          {.reach_px = kEquationReachPx}),
      // Less is rounded, but of C's products only one, so neighbours no longer compute opposite values.
      method<EdgeEquations<true>>(
          {"float_equation_fma", "float_equation with fused multiply-adds, as compilers make them",
           "-ffp-contract=fast, GCC's default", "wrong only within 1.5 px of an edge", false},
          {.reach_px = kEquationReachPx}),
      // A step errs by 2^-24 of the value, which is the edge's length times the distance from its line. Over
      // 4096 rows and 4096 columns to a pixel on the line, these distances sum to at most
      // 4096^2 sqrt(1 / 4 + 9 / 4) px.
      method<FloatIncremental>(
          {"float_incremental", "float edge functions stepped by additions, top-left rule",
           "Pineda 1988, in floats", "wrong only within 1.6 px of an edge", false},
          {.reach_px = 1.6}),
      // Products of two floats are exact in double, but the differences before them may round. The reach is
      // kFloatReachPx with 2^-53 for 2^-24.
      method<DoubleTopLeft>(
          {"double_top_left", "double edge functions with the top-left rule, vertices not snapped",
           "the usual remedy for float errors", "wrong only within 1e-11 px of an edge", false},
          {.reach_px = 1e-11}),
      // Moving edges jitter, and small triangles vanish or flip.
      method<FixedEdges<0, std::int64_t>>(
          {"whole_pixel", "vertices rounded to whole pixels, exact integers after that",
           "engines of the 8- and 16-bit home computers", "wrong only within 0.708 px of an edge; watertight",
           false},
          watertight(0)),
      // As in the first 3D accelerators and many software rasterizers since.
      method<FixedEdges<4, std::int64_t>>({"fixed_4", "vertices snapped to 1/16 px, 64-bit edge functions",
                                           "Giesen, \"Triangle rasterization in practice\"",
                                           "wrong only within 0.0442 px of an edge; watertight", false},
                                          watertight(4)),
      method<FixedEdges<4, std::int32_t>>(
          {"fixed_4_int32", "vertices snapped to 1/16 px, 32-bit edge functions that wrap",
           "Giesen, \"Triangle rasterization in practice\", at the range it states",
           "as fixed_4 for triangles of at most 2896 px; anything inside the bounding box beyond", false},
          watertight_up_to(2896, 4)),
      // As Direct3D requires. Snaps like our contract, but shares no loop with the backends.
      method<FixedEdges<8, std::int64_t>>({"fixed_8", "vertices snapped to 1/256 px, 64-bit edge functions",
                                           "Direct3D 11.3 functional specification, 3.4.1",
                                           "exact coverage of the positions snapped to 1/256 px", true},
                                          watertight(8)),
      method<FixedEdges<8, std::int32_t>>(
          {"fixed_8_int32", "vertices snapped to 1/256 px, 32-bit edge functions that wrap",
           "Giesen, \"Triangle rasterization in practice\", past the range it states",
           "as fixed_8 for triangles of at most 181 px; anything inside the bounding box beyond", false},
          watertight_up_to(181, 8)),
      // A sixteenth of the snapping error, and eight more bits in each product.
      method<FixedEdges<12, std::int64_t>>(
          {"fixed_12", "vertices snapped to 1/4096 px, 64-bit edge functions",
           "finer than any graphics API asks for", "wrong only within 0.000173 px of an edge; watertight",
           false},
          watertight(12)),
      // 64-bit edge values suffice for triangles of up to 16384 px.
      method<FixedEdges<16, std::int64_t>>(
          {"fixed_16", "vertices snapped to 1/65536 px, 64-bit edge functions",
           "16.16 coordinates, with wide products", "wrong only within 0.0000108 px of an edge; watertight",
           false},
          watertight(16)),
      // Up to 4096 steps, each with an error of half an ulp of a number below 4096: 2^-13 px. The first row's
      // error is small.
      method<DdaFloat>({"dda_float", "scanline, x of an edge accumulated in float from row to row",
                        "Hecker, \"Perspective Texture Mapping\", part I, 1995",
                        "wrong only within 0.51 px of an edge; no gaps", false},
                       {.reach_px = 0.51, .no_gaps = true}),
      // A slope errs by less than 2^-16 px per row, over up to 4096 rows; a vertex errs by half of 2^-16 px.
      method<Dda1616>({"dda_16_16", "scanline, x of an edge accumulated in 16.16 fixed point",
                       "Byggmastar, \"Fast affine texture mapping II\", 1997",
                       "wrong only within 0.063 px of an edge; no gaps; wraps past 32767 px", false},
                      {.reach_px = 0.063, .no_gaps = true, .snap_bits = 16}),
      // Vertices move by at most 0.71 px, the + 1 moves an edge by less than a row, and x is truncated to a
      // pixel.
      method<DdaRounded>(
          {"dda_rounded", "scanline between vertices rounded to pixels, ends included, height + 1",
           "tinyrenderer's lesson 2 in its first form", "wrong only within 2.75 px of an edge", false},
          {.reach_px = 2.75}),
  };
}

}  // namespace edgewise::lab
#endif

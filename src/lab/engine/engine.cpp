#include "lab/engine/engine.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "edgewise/contract.h"
#include "lab/coverage/float_edges.h"
#include "lab/coverage/group_runs.h"
#include "lab/engine/engine_kernel.h"
#include "raster/ablation.h"
#include "raster/tiles.h"

namespace edgewise::lab {

namespace {

EngineKernel engine_kernel(EngineNumbers numbers, SimdTarget target) {
  for (const auto kernel_in_file : {fixed_engine_kernel, real_engine_kernel})
    if (const EngineKernel kernel = kernel_in_file(numbers, target); kernel.draw_tile != nullptr)
      return kernel;
  throw std::invalid_argument("not numbers of the engine");
}

}  // namespace

void draw_engine(EngineNumbers numbers, const CoverageInput& input, Window window, FrameView frame,
                 std::uint32_t background, const Execution& execution, TileScratch& scratch) {
  Execution resolved = execution;
  resolved.target = resolve(execution.target);
  const EngineKernel kernel = engine_kernel(numbers, resolved.target);
  StoredTriangles triangles(input.snapped);
  draw_in_tiles(
      triangles, frame, background, resolved, {.coverage_masks = false}, resolved.tile_size, scratch,
      Bins::Small::as_indices,
      [&](const TileTask& task) {
        kernel.draw_tile({task, input.floats.data(), window.x0, window.y0, kernel.reads_floats});
      },
      kernel.margin);
}

namespace {

constexpr int kBeside_px = 4;  // whole blocks are tested, so wrong pixels may lie beside the box

// A triangle with the same bounding box, widened by kBeside_px.
ScreenTriangle with_wider_box(const ScreenTriangle& t) {
  const auto [min_x, max_x] = std::minmax({t.x_sub[0], t.x_sub[1], t.x_sub[2]});
  const auto [min_y, max_y] = std::minmax({t.y_sub[0], t.y_sub[1], t.y_sub[2]});
  constexpr std::int32_t kMargin = kBeside_px * contract::kSub;
  return {{min_x - kMargin, max_x + kMargin, max_x}, {min_y - kMargin, max_y + kMargin, max_y}, {}, 0};
}

void engine_runs(EngineNumbers numbers, const CoverageInput& input, Window window, std::vector<Run>& runs) {
  std::vector<ScreenTriangle> triangles = shifted(input.snapped, window), boxes;
  // At one depth no plane is steep: float coverage outside the snapped triangle then keeps its depth.
  for (ScreenTriangle& t : triangles) t.z[0] = t.z[1] = t.z[2] = contract::kDepthHead;
  for (const ScreenTriangle& t : triangles) boxes.push_back(with_wider_box(t));
  TileScratch scratch;
  std::vector<ScreenTriangle> snapped;
  std::vector<FloatTriangle> floats;
  group_runs(boxes, window, runs, [&](std::span<const std::uint32_t> group, Framebuffer& frame) {
    snapped.clear(), floats.clear();
    for (const std::uint32_t i : group) {
      snapped.push_back(triangles[i]);
      floats.push_back(input.floats[i]);
    }
    draw_engine(numbers, {floats, snapped}, window, frame.view(), kNoTriangle, {}, scratch);
  });
}

CoverageMethod make(EngineNumbers numbers, const MethodInfo& info, const CoveragePromise& promise) {
  return {.info = info,
          .promise = promise,
          .draw =
              [numbers](const CoverageInput& input, Canvas& canvas, const Execution& execution) {
                draw_engine(numbers, input, canvas.window(), canvas.frame.view(), 0, execution,
                            canvas.scratch);
              },
          .runs = [numbers](const CoverageInput& input, Window window,
                            std::vector<Run>& runs) { engine_runs(numbers, input, window, runs); },
          .threaded = true,
          .contract_depth = true,
          .simd = true,
          .engine = true};
}

constexpr std::string_view kSource = "the SIMD engine of src/raster/tiled";
// Snapping errs by half a unit on each axis: sqrt(2) / 512.
constexpr double kSnap_px = 0.00277;
// E is the difference of two sums that round as those of kFloatReachPx, and is then stepped.
constexpr double kFloat_px = 4 * kFloatReachPx;
constexpr std::string_view kFloatPromise = "wrong only within 0.0112 px of an edge's line";

}  // namespace

std::span<const CoverageMethod> engine_methods() {
  static const std::vector<CoverageMethod> methods{
      make(EngineNumbers::exact,
           {"engine_exact", "the SIMD engine with the contract's numbers", kSource,
            "exact coverage of the positions snapped to 1/256 px", true},
           {.reach_px = kSnap_px, .no_gaps = true, .no_double_hits = true}),
      make(EngineNumbers::float_lt,
           {"engine_float_lt", "the SIMD engine with float edges; samples on an edge are outside", kSource,
            kFloatPromise, false},
           {.reach_px = kFloat_px}),
      make(EngineNumbers::float_le,
           {"engine_float_le", "the SIMD engine with float edges; samples on an edge are inside", kSource,
            kFloatPromise, false},
           {.reach_px = kFloat_px}),
      make(EngineNumbers::float_top_left,
           {"engine_float_top_left", "the SIMD engine with float edges and the top-left rule", kSource,
            kFloatPromise, false},
           {.reach_px = kFloat_px}),
      make(EngineNumbers::float_rebased,
           {"engine_float_rebased", "the SIMD engine with float edges relative to the tile's corner", kSource,
            kFloatPromise, false},
           {.reach_px = kFloat_px}),
      make(EngineNumbers::float_snapped,
           {"engine_float_snapped", "the SIMD engine with float edges of the snapped vertices", kSource,
            "wrong only within 0.014 px of an edge's line", false},
           {.reach_px = kFloat_px + kSnap_px}),
      make(EngineNumbers::fixed_4_int32,
           {"engine_fixed_4_int32", "the SIMD engine with vertices at 1/16 px and 32-bit edges that wrap",
            kSource,
            "wrong by snapping alone for triangles of at most 2893 px; any pixel of the box's blocks beyond",
            false},
           {.reach_px = 0.05, .max_side_px = 2893, .no_gaps = true, .no_double_hits = true}),
      make(EngineNumbers::fixed_8_int32,
           {"engine_fixed_8_int32", "the SIMD engine with vertices at 1/256 px and 32-bit edges that wrap",
            kSource, "exact for triangles of at most 178 px; any pixel of the box's blocks beyond", false},
           {.reach_px = kSnap_px, .max_side_px = 178, .no_gaps = true, .no_double_hits = true}),
      make(EngineNumbers::fixed_8_int64,
           {"engine_fixed_8_int64", "the SIMD engine with 64-bit integer edges", kSource,
            "exact coverage of the positions snapped to 1/256 px", true},
           {.reach_px = kSnap_px, .no_gaps = true, .no_double_hits = true}),
      make(EngineNumbers::double_top_left,
           {"engine_double", "the SIMD engine with double edges and the top-left rule", kSource,
            "wrong only within 0.003 px of an edge's line; exact for vertices on the 1/256 px grid", false},
           {.reach_px = kSnap_px, .no_gaps = true, .no_double_hits = true, .if_on_grid = true})};
  return methods;
}

}  // namespace edgewise::lab

#include "lab/engine/engine.h"

#include <algorithm>
#include <vector>

#include "edgewise/contract.h"
#include "lab/coverage/draw_in_sets.h"
#include "raster/traversals.h"

namespace edgewise::lab {

std::unique_ptr<Backend> make_engine(EngineArithmetic arithmetic) {
  return tile_backend([arithmetic](SimdTarget target) { return engine_kernel(arithmetic, target); },
                      {.coverage_masks = false});
}

namespace {

// Whole blocks of 4 x 4 px are tested, so wrong pixels may lie beside the box.
constexpr std::int32_t kBeside = 4 * contract::kPixel_q15;

// A triangle with the same bounding box, widened by kBeside.
ScreenTriangle with_wider_box(const ScreenTriangle& t) {
  const auto [min_x, max_x] = std::minmax({t.x_q15[0], t.x_q15[1], t.x_q15[2]});
  const auto [min_y, max_y] = std::minmax({t.y_q15[0], t.y_q15[1], t.y_q15[2]});
  return {{min_x - kBeside, max_x + kBeside, max_x}, {min_y - kBeside, max_y + kBeside, max_y}, {}, 0};
}

void engine_runs(EngineArithmetic arithmetic, const CoverageInput& input, Window window,
                 std::vector<Run>& runs) {
  std::vector<ScreenTriangle> triangles = shifted(input.snapped, window), boxes;
  // At one depth no plane is steep: wrong pixels beside the triangle then keep its depth.
  for (ScreenTriangle& t : triangles) t.z[0] = t.z[1] = t.z[2] = contract::kDepthHead;
  for (const ScreenTriangle& t : triangles) boxes.push_back(with_wider_box(t));
  const auto engine = make_engine(arithmetic);
  std::vector<ScreenTriangle> drawn;
  draw_in_sets(boxes, window, runs, [&](std::span<const std::uint32_t> set, Framebuffer& frame) {
    drawn.clear();
    for (const std::uint32_t i : set) drawn.push_back(triangles[i]);
    engine->draw(drawn, frame.view(), {kNoTriangle});
  });
}

CoverageMethod make(EngineArithmetic arithmetic, const MethodInfo& info, const CoveragePromise& promise) {
  return {.info = info,
          .promise = promise,
          .draw =
              [arithmetic, name = info.name](const CoverageInput& input, Canvas& canvas,
                                             const Execution& execution) {
                canvas.backend(name, [&] { return make_engine(arithmetic); })
                    .draw(input.snapped, canvas.frame.view(), {0}, execution);
              },
          .runs = [arithmetic](const CoverageInput& input, Window window,
                               std::vector<Run>& runs) { engine_runs(arithmetic, input, window, runs); },
          .threaded = true,
          .contract_depth = true,
          .simd = true,
          .engine = true};
}

constexpr std::string_view kSource = "the SIMD engine of src/raster/edges";
constexpr std::string_view kExact = "exact coverage of the positions snapped to 1/256 px";
// Snapping errs by half a unit on each axis: sqrt(2) / 512.
constexpr double kSnap_px = 0.00277;
constexpr CoveragePromise kSnapping{
    .reach_px = kSnap_px, .no_gaps = true, .no_double_hits = true, .snap_bits = 8};
// Each of the two sums (other_arithmetic-inl.h) errs by at most 2 * 2^-24 times the edge's length times 4096
// sqrt(2) px. What is rounded later, inside a tile, adds less than a tenth. In all that is 0.0015 px off the
// snapped edge's line.
constexpr CoveragePromise kFloat{.reach_px = 0.0015 + kSnap_px, .snap_bits = 8};
constexpr std::string_view kFloatPromise = "wrong only within 0.0043 px of an edge's line";

}  // namespace

std::span<const CoverageMethod> engine_methods() {
  static const std::vector<CoverageMethod> methods{
      make(EngineArithmetic::exact,
           {"engine_exact", "the SIMD engine with the contract's numbers", kSource, kExact, true}, kSnapping),
      make(EngineArithmetic::int64,
           {"engine_int64", "the SIMD engine with 64-bit integer edges", kSource, kExact, true}, kSnapping),
      make(EngineArithmetic::float64,
           {"engine_double", "the SIMD engine with double edges", kSource, kExact, true}, kSnapping),
      make(EngineArithmetic::float32,
           {"engine_float", "the SIMD engine with float edges", kSource, kFloatPromise, false}, kFloat),
      make(EngineArithmetic::float32_rebased,
           {"engine_float_rebased", "the SIMD engine with float edges relative to the tile's corner", kSource,
            kFloatPromise, false},
           kFloat),
      make(EngineArithmetic::int32,
           {"engine_int32", "the SIMD engine with 32-bit integer edges that wrap", kSource,
            "exact for triangles of at most 178 px; any pixel of the box's blocks beyond", false},
           {.reach_px = kSnap_px,
            .max_side_px = 178,
            .no_gaps = true,
            .no_double_hits = true,
            .snap_bits = 8})};
  return methods;
}

}  // namespace edgewise::lab

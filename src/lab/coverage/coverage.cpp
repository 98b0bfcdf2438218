// The registry of coverage methods: the backends, the table in methods.cpp, and the files that the CMake
// variable EDGEWISE_COVERAGE_METHODS lists, each of which defines make_coverage_NAME().
#include "lab/coverage/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/grid.h"
#include "core/nearest_name.h"
#include "frontend/fixed.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/to_stream.h"

#ifndef EDGEWISE_MORE_COVERAGE_METHODS
#define EDGEWISE_MORE_COVERAGE_METHODS(X)
#endif

namespace edgewise::lab {

#define EDGEWISE_DECLARE(name) CoverageMethod make_coverage_##name();
EDGEWISE_MORE_COVERAGE_METHODS(EDGEWISE_DECLARE)

namespace {

// Triangles relative to the window's corner, each with its index as payload. Throws std::invalid_argument for
// one that then lies beyond the guard band.
std::vector<ScreenTriangle> shifted(std::span<const ScreenTriangle> triangles, Window window) {
  std::vector<ScreenTriangle> list(triangles.begin(), triangles.end());
  for (std::uint32_t index = 0; ScreenTriangle & t : list) {
    for (int i = 0; i < 3; ++i) {
      const std::int64_t x = t.x_q15[i] - std::int64_t{window.x0} * contract::kPixel_q15,
                         y = t.y_q15[i] - std::int64_t{window.y0} * contract::kPixel_q15;
      if (std::max(std::abs(x), std::abs(y)) > contract::kGuard_q15)
        throw std::invalid_argument("triangle " + std::to_string(index) + " lies beyond the guard band");
      t.x_q15[i] = static_cast<std::int32_t>(x), t.y_q15[i] = static_cast<std::int32_t>(y);
    }
    t.payload = index++;
  }
  return list;
}

// The pixels of each triangle: triangles are drawn in sets with disjoint bounding boxes.
void backend_runs(Backend& backend, std::span<const ScreenTriangle> snapped, Window window,
                  std::vector<Run>& runs) {
  const std::vector<ScreenTriangle> triangles = shifted(snapped, window);
  Framebuffer frame(window.width, window.height);
  std::vector<ScreenTriangle> drawn;
  for (const auto& set : disjoint_sets(triangles, window.width, window.height)) {
    drawn.clear();
    for (const std::uint32_t i : set) drawn.push_back(triangles[i]);
    backend.draw(drawn, frame.view(), {kNoTriangle});
    for (int y = 0; y < window.height; ++y)
      append_runs({frame.payload_row(y), static_cast<std::size_t>(window.width)}, y + window.y0, window.x0,
                  runs);
  }
}

// Rule 2; the current rounding mode is half to even.
std::int32_t to_q15(float px, int bits) {
  return static_cast<std::int32_t>(std::nearbyint(double{px} * (1 << bits))) *
         (1 << (contract::kFineBits - bits));
}

CoverageMethod make_from(const BackendInfo& backend, bool fills) {
  constexpr double kSnap = 0.00277;  // half a sub-unit on both axes: sqrt(2) / 512
  return {
      {backend.name, backend.summary, "src/raster", "exact coverage of the positions snapped to 1/256 px",
       true},
      {.reach_px = kSnap, .no_gaps = true, .no_double_hits = true, .snap_bits = Coarse::kSubBits},
      [&backend](const CoverageInput& input, Canvas& canvas, const Execution& execution) {
        canvas.backend(backend.name, backend.make).draw(input.snapped, canvas.frame.view(), {0}, execution);
      },
      [&backend](const CoverageInput& input, Window window, std::vector<Run>& runs) {
        backend_runs(*backend.make(), input.snapped, window, runs);
      },
      true,
      true,
      true,
      fills,
      backend.name != "naive"};  // which ignores Execution::target
}

}  // namespace

Canvas::Canvas(int width, int height)
    : frame(width, height),
      depth(static_cast<std::size_t>(frame.stride()) * static_cast<std::size_t>(height)) {}

Backend& Canvas::backend(std::string_view name, const std::function<std::unique_ptr<Backend>()>& make) {
  auto& slot = backends_[name];
  if (!slot) slot = make();
  return *slot;
}

std::span<const CoverageMethod> drawing_methods() {
  static const std::vector<CoverageMethod> list = [] {
    std::vector<CoverageMethod> methods;
    for (const auto& backend : backends()) methods.push_back(make_from(backend, true));
    std::ranges::move(coverage_table(), std::back_inserter(methods));
#define EDGEWISE_ENTRY(name) methods.push_back(make_coverage_##name());
    EDGEWISE_MORE_COVERAGE_METHODS(EDGEWISE_ENTRY)
    methods.push_back(make_from(wireframe(), false));
    for (const auto& composition : compositions()) methods.push_back(make_from(composition, true));
    return methods;
  }();
  return list;
}

std::span<const CoverageMethod> coverage_methods() {
  return drawing_methods().first(drawing_methods().size() - 1 - compositions().size());
}

bool same_picture(const CoverageMethod& method, const Canvas& a, const Canvas& b) {
  const auto equal = [width = static_cast<std::size_t>(a.frame.width())](const auto* row, const auto* other) {
    return std::memcmp(row, other, width * sizeof *row) == 0;
  };
  if (a.frame.width() != b.frame.width() || a.frame.height() != b.frame.height()) return false;
  for (int y = 0; y < a.frame.height(); ++y) {
    const std::ptrdiff_t at = y * a.frame.stride();
    if (!equal(a.frame.payload_row(y), b.frame.payload_row(y)) ||
        !(method.contract_depth ? equal(a.frame.depth_row(y), b.frame.depth_row(y))
                                : equal(a.depth.data() + at, b.depth.data() + at)))
      return false;
  }
  return true;
}

const CoverageMethod& find_drawing_method(std::string_view name) {
  return find_named("backend or coverage method", name, drawing_methods(),
                    [](const CoverageMethod& m) { return m.info.name; });
}

void append_runs(std::span<const std::uint32_t> row, int y, int x0, std::vector<Run>& runs) {
  for (auto begin = row.begin(); begin != row.end();) {
    const std::uint32_t triangle = *begin;
    const auto end = std::find_if(begin, row.end(), [&](std::uint32_t other) { return other != triangle; });
    if (triangle != kNoTriangle)
      runs.push_back({triangle, y, x0 + static_cast<int>(begin - row.begin()),
                      x0 + static_cast<int>(end - row.begin())});
    begin = end;
  }
}

std::vector<ScreenTriangle> snapped(std::span<const FloatTriangle> triangles, int subpixel_bits) {
  std::vector<ScreenTriangle> result(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[i].x_q15[k] = to_q15(triangles[i].at.x_px[k], subpixel_bits);
      result[i].y_q15[k] = to_q15(triangles[i].at.y_px[k], subpixel_bits);
      result[i].z[k] = quantize_depth(triangles[i].at.z01[k]);
    }
    result[i].payload = triangles[i].payload;
  }
  return result;
}

std::vector<FloatTriangle> unsnapped(std::span<const ScreenTriangle> triangles,
                                     std::span<const UnsnappedTriangle> at) {
  if (triangles.size() != at.size())
    throw std::invalid_argument("the front end did not keep unsnapped triangles");
  std::vector<FloatTriangle> result;
  result.reserve(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) result.push_back({at[i], triangles[i].payload});
  return result;
}

void CoverageScene::keep_if(const std::function<bool(std::size_t)>& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < floats.size(); ++i) {
    if (!keep(i)) continue;
    floats[kept] = floats[i];
    snapped[kept++] = snapped[i];
  }
  floats.resize(kept);
  snapped.resize(kept);
}

CoverageScene coverage_scene_of_floats(const Drawable& drawable, FrontendOptions options) {
  if (const auto rounded = in_floats(drawable)) return coverage_scene_of_floats(*rounded, options);
  const Cull cull = std::exchange(options.cull, Cull::none);
  options.keep_unsnapped = true;
  Frontend frontend;
  const auto screen = frontend.run(drawable, options);
  CoverageScene scene{{options.width, options.height},
                      unsnapped(screen, frontend.unsnapped()),
                      {screen.begin(), screen.end()},
                      options.subpixel_bits};
  if (cull != Cull::none)
    scene.keep_if([&](std::size_t i) { return keeps(cull, FloatTruth(scene.floats[i].at).facing()); });
  return scene;
}

}  // namespace edgewise::lab

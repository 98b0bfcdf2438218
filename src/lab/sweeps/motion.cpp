// Coverage in motion: pixels that flicker while a mesh moves slowly, and whether the mesh stays watertight.
#include <algorithm>
#include <cmath>

#include "lab/sweeps/coverage.h"

namespace edgewise::lab {

Sweep make_sweep_pan();
Sweep make_sweep_translation();

namespace {

// A window onto the middle of a mesh.
struct View {
  int window_px, margin_px;
  double cell_px;
  std::vector<FloatTriangle> mesh(int steps_per_px, double x, double y) const {
    return moved_mesh(window_px + 2 * margin_px, cell_px, 1, steps_per_px, x, y);
  }
  Window window(int moved_px) const {
    return {window_px, window_px, margin_px + moved_px, margin_px + moved_px};
  }
};

using Picture = std::vector<std::uint32_t>;  // per pixel the first triangle drawn there, or kNoTriangle

Picture picture_of(std::span<const Run> runs, Window window) {
  Picture picture(static_cast<std::size_t>(window.width * window.height), kNoTriangle);
  for (const Run& run : runs) {
    if (run.y < window.y0 || run.y >= window.y1()) continue;
    const auto row = picture.begin() + std::ptrdiff_t{run.y - window.y0} * window.width;
    for (int x = std::max(run.x0, window.x0); x < std::min(run.x1, window.x1()); ++x)
      row[x - window.x0] = std::min(row[x - window.x0], run.triangle);
  }
  return picture;
}

// Counts how often each pixel changes from one frame to the next.
class Changes {
 public:
  void add(Picture picture) {
    if (last_.empty()) count_.assign(picture.size(), 0);
    for (std::size_t i = 0; i < last_.size(); ++i) count_[i] += picture[i] != last_[i];
    last_ = std::move(picture);
  }
  std::uint64_t sum() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : count_) sum += count;
    return sum;
  }
  std::uint64_t beyond(const Changes& truth) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count_.size(); ++i)
      sum += count_[i] > truth.count_[i] ? count_[i] - truth.count_[i] : 0;
    return sum;
  }

 private:
  Picture last_;
  std::vector<std::uint32_t> count_;
};

Measured measure_pan(double speed_px, bool quick) {
  const auto methods = coverage_methods();
  constexpr View kView{64, 16, 8.0};
  const Window window = kView.window(0);
  const int frames = std::min(quick ? 128 : 2048, static_cast<int>(kView.margin_px / speed_px));
  Changes truth, snapping;
  std::vector<Changes> changes(methods.size());
  std::vector<Run> runs;
  for (int frame = 0; frame < frames; ++frame) {
    const double way = frame * speed_px;
    const auto triangles = kView.mesh(0, way, way / 2);
    const auto grid = snapped(triangles);
    truth.add(picture_of(covered_runs(triangles, window, 1), window));
    snapping.add(picture_of(covered_runs(grid, window, 1), window));
    for (std::size_t i = 0; i < methods.size(); ++i) {
      runs.clear();
      methods[i].runs({triangles, grid}, window, runs);
      changes[i].add(picture_of(runs, window));
    }
  }
  Measured result(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i)
    result.methods[i] = {changes[i].beyond(truth), truth.sum()};
  result.by_snapping = snapping.beyond(truth);
  return result;
}

// The number of pixels that are not drawn exactly once. The mesh covers the whole window, which moves with it
// by whole pixels.
std::uint64_t not_once(std::span<const Run> runs, Window window) {
  const auto hits = hits_of(runs, window);
  return static_cast<std::uint64_t>(
      std::count_if(hits.begin(), hits.end(), [](std::uint32_t count) { return count != 1; }));
}

Measured measure_translation(double step_px, bool quick) {
  const auto methods = coverage_methods();
  constexpr View kView{256, 48, 88.0};
  constexpr int kStepsPerPx = 4;  // a grid so coarse that samples lie on edges
  Measured sums(methods.size());
  std::vector<Run> runs;
  for (int frame = 0; frame < (quick ? 8 : 256); ++frame) {
    const double way = frame * step_px;
    const auto triangles = kView.mesh(kStepsPerPx, way, way);
    const auto grid = snapped(triangles);
    const Window window = kView.window(static_cast<int>(way));
    const std::uint64_t crossings = edge_crossings(triangles, window);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      runs.clear();
      methods[i].runs({triangles, grid}, window, runs);
      sums.methods[i] += {not_once(runs, window), crossings};
    }
    sums.by_snapping += not_once(covered_runs(grid, window, 1), window);
  }
  return sums;
}

}  // namespace

Sweep make_sweep_pan() {
  return {"pan",
          Family::coverage,
          "a mesh pans slowly: pixels that change though the truth does not",
          {"speed", "px per frame", true},
          {"superfluous changes per 10^6 true ones", true, 1e6},
          10,
          powers_of_two(-1, -10),
          measure_pan};
}

Sweep make_sweep_translation() {
  return {"translation",
          Family::coverage,
          "a mesh on the 1/4 px grid moves by whole pixels, then by less",
          {"step", "px", true},
          {"gaps and double hits per 10^6 edge crossings", true, 1e6},
          30,
          powers_of_two(3, -12),
          measure_translation};
}

}  // namespace edgewise::lab

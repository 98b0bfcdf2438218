// Coverage sweeps: distance from the origin, aspect, size and height of triangles, with vertices on the grid
// of 1/256 px, where our snapping is exact, and off it; and coverage in motion, where pixels flicker while a
// mesh moves slowly, and which shows whether the mesh stays watertight.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "lab/coverage/changes.h"
#include "lab/coverage/score.h"
#include "lab/sweeps/sweeps.h"
#include "scene/streams.h"

namespace edgewise::lab {

namespace {

constexpr YAxis kErrorsPerCrossing{"wrong pixels per 10^6 edge crossings", true, 1e6, 1e6 * kTolerance};

// Adds each method's errors in a picture, against the float truth.
void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window) {
  const auto grid = snapped(triangles);
  const CoverageInput input{triangles, grid};
  const CoverageTruth truth = float_coverage(input, window, 1);
  const std::uint64_t crossings = edge_crossings(triangles, window);
  const auto methods = coverage_methods();
  for (std::size_t i = 0; i < methods.size(); ++i)
    sums.methods[i] += {score_coverage(truth, {methods[i], input, window}, triangles).errors(), crossings};
}

// For vertices on the grid of 1/256 px both truths agree, so that all errors come from arithmetic or from
// snapping that is coarser than ours.
enum Grid { kOffGrid = 0, kOnGrid = 256 };

// The nearest multiple of 1 / steps_per_px px, or `px` if steps_per_px is 0.
double on_grid(double px, int steps_per_px) {
  return steps_per_px == 0 ? px : std::nearbyint(px * steps_per_px) / steps_per_px;
}

// A jittered grid of cells. Rounds the vertices as on_grid() does, and then moves them by (x, y) px.
std::vector<FloatTriangle> moved_mesh(int side_px, double cell_px, std::uint64_t seed, int steps_per_px,
                                      double x, double y) {
  auto mesh = float_triangles(jittered_grid({.width = side_px, .height = side_px}, cell_px, seed));
  for (auto& [at, payload] : mesh)
    for (int i = 0; i < 3; ++i) {
      at.x_px[i] = static_cast<float>(on_grid(double{at.x_px[i]}, steps_per_px) + x);
      at.y_px[i] = static_cast<float>(on_grid(double{at.y_px[i]}, steps_per_px) + y);
    }
  return mesh;
}

constexpr int kWindowPx = 96;

FloatTriangle flat(const glm::vec2 (&corner)[3]) {
  FloatTriangle t{{{}, {}, {0.5f, 0.5f, 0.5f}}, 1};
  for (int i = 0; i < 3; ++i) t.at.x_px[i] = corner[i].x, t.at.y_px[i] = corner[i].y;
  return t;
}

// An ulp is 1/256 px at 2^15 px and 1/8 px at 2^20 px, so vertices stay on the grid at every distance, and
// from 2^15 px on all lie on it.
template <Grid kGrid>
Measured measure_distance(double distance, bool quick) {
  Measured sums(coverage_methods().size());
  // Cells are so small that float products are exact near the origin.
  constexpr double kCellPx = 8;
  const int corner = static_cast<int>(distance);
  for (std::uint64_t seed = 1; seed <= (quick ? 4 : 64); ++seed)
    add_picture(sums, moved_mesh(kWindowPx, kCellPx, seed, kGrid, corner, corner),
                {kWindowPx, kWindowPx, corner, corner});
  return sums;
}

// Pairs of triangles side by side; each pair shares a long edge with the next.
struct Strip {
  double length_px, width_px;  // of a pair, along and across
  double skew_px;              // offset of the lower end across
  Grid grid;
  static constexpr int kPairs = 6;

  // Vertical strips, or horizontal ones (`lying`), mirrored at the image's diagonal.
  std::vector<FloatTriangle> triangles(bool lying, Random& random) const {
    const double left = 2.0 + double{random.uniform(0, 1)}, top = 1.0 + double{random.uniform(0, 1)};
    const auto corner = [&](int edge, bool low) {
      const double jitter = double{random.uniform(-0.2f, 0.2f)} * width_px;
      const auto across = static_cast<float>(
                     on_grid(left + edge * width_px + (low ? skew_px : 0.0) + jitter, grid)),
                 along = static_cast<float>(on_grid(top + (low ? length_px : 0.0), grid));
      return lying ? glm::vec2(along, across) : glm::vec2(across, along);
    };
    std::vector<FloatTriangle> list;
    glm::vec2 upper = corner(0, false), lower = corner(0, true);
    for (int pair = 1; pair <= kPairs; ++pair) {
      const glm::vec2 next_upper = corner(pair, false), next_lower = corner(pair, true);
      list.push_back(flat({upper, next_upper, next_lower}));
      list.push_back(flat({upper, next_lower, lower}));
      upper = next_upper, lower = next_lower;
    }
    return list;
  }
  int height() const { return static_cast<int>(length_px) + 4; }
  int width() const { return static_cast<int>(kPairs * width_px + skew_px) + 8; }
};

// Vertical and horizontal strips in pictures that contain all of them, to see errors that accumulate along
// edges. Diagonal strips, whose products need the most bits, in three bands of rows only, since their boxes
// are large.
void add_strips(Measured& sums, double length_px, double width_px, int count, std::uint64_t seed, Grid grid) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const Strip strip{length_px, width_px, double{random.uniform(0, 24)}, grid};
    add_picture(sums, strip.triangles(false, random), {strip.width(), strip.height()});
    add_picture(sums, strip.triangles(true, random), {strip.height(), strip.width()});
    const double side = length_px * std::numbers::sqrt2 / 2;
    const Strip diagonal{side, width_px * std::numbers::sqrt2, side, grid};
    const auto triangles = diagonal.triangles(false, random);
    constexpr int kRows = 16;
    const int below = std::max(diagonal.height() - kRows, 0);
    for (const int band : {0, 1, 2})
      add_picture(sums, triangles, {diagonal.width(), kRows, 0, below * band / 2});
  }
}

int strip_count(double length_px, bool quick) {
  const int few = length_px < 1024 ? 8 : 1;
  return quick ? few : 8 * few;
}

// Strips 16 px wide with a length up to 4096 px; for higher aspects the width shrinks down to 1/256 px.
template <Grid kGrid>
Measured measure_aspect(double aspect, bool quick) {
  constexpr double kWidthPx = 16, kLongestPx = 4096;
  Measured sums(coverage_methods().size());
  const double length = std::min(kWidthPx * aspect, kLongestPx);
  add_strips(sums, length, std::max(length / aspect, 1.0 / 256), strip_count(length, quick), 13, kGrid);
  return sums;
}

template <Grid kGrid>
Measured measure_height(double rows, bool quick) {
  constexpr double kWidthPx = 9;
  Measured sums(coverage_methods().size());
  add_strips(sums, rows, kWidthPx, strip_count(rows, quick), 12, kGrid);
  return sums;
}

// Squares of two right triangles at two places, on the grid one at whole pixels, in three bands of rows.
template <Grid kGrid>
Measured measure_legs(double legs, bool) {
  Measured sums(coverage_methods().size());
  constexpr int kRows = 24;
  const auto leg = static_cast<float>(legs);
  const glm::vec2 off = kGrid == kOnGrid ? glm::vec2(0.0f) : glm::vec2(0.3f, 0.9f) / 256.0f;
  for (const glm::vec2 a : {off, off + glm::vec2(37.0f / 256, 101.0f / 256)}) {
    const glm::vec2 b = a + glm::vec2(leg, 0), c = a + glm::vec2(0, leg), d = a + glm::vec2(leg);
    for (const int band : {0, 1, 2})
      add_picture(sums, {flat({a, b, c}), flat({d, c, b})},
                  {static_cast<int>(legs) + 1, kRows, 0, static_cast<int>(legs - kRows) * band / 2});
  }
  return sums;
}

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

Measured measure_pan(double speed_px, bool quick) {
  const auto methods = coverage_methods();
  constexpr View kView{64, 16, 8.0};
  const Window window = kView.window(0);
  const int frames = std::min(quick ? 128 : 2048, static_cast<int>(kView.margin_px / speed_px));
  Changes truth;
  std::vector<Changes> changes(methods.size());
  std::vector<Run> runs;
  for (int frame = 0; frame < frames; ++frame) {
    const double way = frame * speed_px;
    const auto triangles = kView.mesh(0, way, way / 2);
    const auto grid = snapped(triangles);
    truth.add(picture_of(covered_runs(triangles, window, 1), window));
    for (std::size_t i = 0; i < methods.size(); ++i) {
      runs.clear();
      methods[i].runs({triangles, grid}, window, runs);
      changes[i].add(picture_of(runs, window));
    }
  }
  Measured result(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i)
    result.methods[i] = {changes[i].beyond(truth), truth.sum()};
  return result;
}

// The number of pixels that are not drawn exactly once. The mesh covers the whole window, which moves with it
// by whole pixels.
std::uint64_t not_once(std::span<const Run> runs, Window window) {
  const auto hits = hits_of(runs, window);
  return static_cast<std::uint64_t>(
      std::count_if(hits.begin(), hits.end(), [](std::uint32_t count) { return count != 1; }));
}

template <Grid kGrid>
Measured measure_translation(double step_px, bool quick) {
  const auto methods = coverage_methods();
  constexpr View kView{256, 48, 88.0};
  constexpr int kStepsPerPx = kGrid == kOnGrid ? 4 : 0;  // a grid so coarse that samples lie on edges
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
  }
  return sums;
}

}  // namespace

std::vector<Sweep> coverage_sweeps() {
  std::vector<Sweep> list{
      {"distance",
       Family::coverage,
       "a fine mesh on the 1/256 px grid, far from the origin",
       {"distance from origin", "px", true},
       kErrorsPerCrossing,
       4.5,
       powers_of_two(0, 20),
       measure_distance<kOnGrid>},
      {"aspect",
       Family::coverage,
       "slivers that share long edges, on the 1/256 px grid",
       {"length over width", "", true},
       kErrorsPerCrossing,
       9,
       decades(0, 6),
       measure_aspect<kOnGrid>},
      {"legs",
       Family::coverage,
       "right triangles on the 1/256 px grid, at the limits of 32-bit edge values",
       {"legs", "px", true},
       kErrorsPerCrossing,
       0.3,
       {64, 90, 128, 181, 182, 256, 362, 512, 724, 1024, 1448, 2048, 2896, 2897, 4096, 5792, 8192},
       measure_legs<kOnGrid>},
      {"height",
       Family::coverage,
       "long shared edges, on the 1/256 px grid: accumulated values drift",
       {"length of the edges", "px", true},
       kErrorsPerCrossing,
       5,
       powers_of_two(3, 13),
       measure_height<kOnGrid>},
      {"pan",
       Family::coverage,
       "a mesh pans slowly: pixels that change though the truth does not",
       {"speed", "px per frame", true},
       {"superfluous changes per 10^6 true ones", true, 1e6, 1e6 * kTolerance},
       10,
       powers_of_two(-1, -10),
       measure_pan},
      {"translation",
       Family::coverage,
       "a mesh on the 1/4 px grid moves by whole pixels, then by less",
       {"step", "px", true},
       {"gaps and double hits per 10^6 edge crossings", true, 1e6, 0.0},
       30,
       powers_of_two(3, -12),
       measure_translation<kOnGrid>}};
  struct OffGrid {
    std::string_view of, name, summary;
    Measured (*measure)(double, bool);
  };
  constexpr OffGrid kOffGrids[] = {
      {"distance", "distance_off_grid", "a fine mesh with vertices anywhere, far from the origin",
       measure_distance<kOffGrid>},
      {"aspect", "aspect_off_grid", "slivers that share long edges, with vertices anywhere",
       measure_aspect<kOffGrid>},
      {"legs", "legs_off_grid", "right triangles off the grid, at the limits of 32-bit edge values",
       measure_legs<kOffGrid>},
      {"height", "height_off_grid", "long shared edges with vertices anywhere: accumulated values drift",
       measure_height<kOffGrid>},
      {"translation", "translation_off_grid",
       "a mesh with vertices anywhere moves by whole pixels, then by less", measure_translation<kOffGrid>}};
  for (const OffGrid& off : kOffGrids) {
    const auto on = std::ranges::find(list, off.of, &Sweep::name);
    Sweep sweep = *on;
    sweep.name = off.name, sweep.summary = off.summary, sweep.measure = off.measure;
    list.insert(on + 1, sweep);
  }
  return list;
}

}  // namespace edgewise::lab

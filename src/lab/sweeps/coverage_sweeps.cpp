// Coverage sweeps: distance from the origin, aspect, size and height of triangles, with vertices on the grid
// of 1/256 px, where our snapping is exact, and off it; and coverage in motion, where pixels flicker while a
// mesh moves slowly.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/grid.h"
#include "core/random.h"
#include "lab/coverage/pixel_changes.h"
#include "lab/coverage/score.h"
#include "lab/sweeps/sweeps.h"
#include "scene/streams.h"

namespace edgewise::lab {

namespace {

constexpr YAxis kErrorsPerCrossing{"wrong samples per 10^6 edge crossings", true, 1e6};

// Adds each method's errors in a picture, against the float truth.
void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window, int bits) {
  const auto grid = snapped(triangles, bits);
  const CoverageInput input{triangles, grid};
  const CoverageTruth truth = float_coverage(input, window, 1);
  const std::uint64_t crossings = edge_crossings(triangles, window);
  const auto methods = coverage_methods();
  for (std::size_t i = 0; i < methods.size(); ++i)
    sums.methods[i] += {score_coverage(truth, {methods[i], input, window}, triangles).errors(), crossings};
}

// For vertices on the grid of 1/256 px both truths agree, so that all errors come from arithmetic or from
// snapping that is coarser than ours.
enum Grid { kOffGrid, kOnGrid };

double on_grid(double px, Grid grid) {
  return grid == kOffGrid ? px : std::nearbyint(px * Coarse::kSub) / Coarse::kSub;
}

// A jittered grid of cells of 8 px, so small that float products are exact near the origin. Rounds the
// vertices as on_grid() does, and then moves them by (x, y) px.
std::vector<FloatTriangle> moved_mesh(int side_px, std::uint64_t seed, Grid grid, double x, double y) {
  auto mesh = float_triangles(jittered_grid({.width = side_px, .height = side_px}, 8.0, seed));
  for (auto& [at, payload] : mesh)
    for (int i = 0; i < 3; ++i) {
      at.x_px[i] = static_cast<float>(on_grid(double{at.x_px[i]}, grid) + x);
      at.y_px[i] = static_cast<float>(on_grid(double{at.y_px[i]}, grid) + y);
    }
  return mesh;
}

FloatTriangle flat(const glm::vec2 (&corner)[3]) {
  FloatTriangle t{{{}, {}, {0.5f, 0.5f, 0.5f}}, 1};
  for (int i = 0; i < 3; ++i) t.at.x_px[i] = corner[i].x, t.at.y_px[i] = corner[i].y;
  return t;
}

// The far corner of the mesh lies at this distance on both axes.
template <Grid kGrid>
Measured measure_distance(double distance, bool quick, int bits) {
  Measured sums(coverage_methods().size());
  constexpr int kSide = 96;
  const int corner = static_cast<int>(distance) - kSide;
  for (std::uint64_t seed = 1; seed <= (quick ? 4 : 64); ++seed)
    add_picture(sums, moved_mesh(kSide, seed, kGrid, corner, corner), {kSide, kSide, corner, corner}, bits);
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
    const double left = 2.0 + double{random.uniform(0, 1)};
    // Each end jitters along the strip, too: one parallel to the rows of samples would err on all or none.
    const auto corner = [&](int edge, bool low) {
      const double jitter = double{random.uniform(-0.2f, 0.2f)} * width_px,
                   end = 1.0 + double{random.uniform(0, 1)};
      const auto across = static_cast<float>(
                     on_grid(left + edge * width_px + (low ? skew_px : 0.0) + jitter, grid)),
                 along = static_cast<float>(on_grid(end + (low ? length_px : 0.0), grid));
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
void add_strips(Measured& sums, double length_px, double width_px, int count, Grid grid, int bits) {
  Random random(1);
  for (int i = 0; i < count; ++i) {
    const Strip strip{length_px, width_px, double{random.uniform(0, 24)}, grid};
    add_picture(sums, strip.triangles(false, random), {strip.width(), strip.height()}, bits);
    add_picture(sums, strip.triangles(true, random), {strip.height(), strip.width()}, bits);
    const double side = length_px * std::numbers::sqrt2 / 2;
    const Strip diagonal{side, width_px * std::numbers::sqrt2, side, grid};
    const auto triangles = diagonal.triangles(false, random);
    constexpr int kRows = 16;
    const int below = std::max(diagonal.height() - kRows, 0);
    for (const int band : {0, 1, 2})
      add_picture(sums, triangles, {diagonal.width(), kRows, 0, below * band / 2}, bits);
  }
}

int strip_count(double length_px, bool quick) {
  const int few = length_px < 1024 ? 8 : 1;
  return quick ? few : 8 * few;
}

// Strips 16 px wide with a length up to 4096 px; for higher aspects the width shrinks down to 1/256 px.
template <Grid kGrid>
Measured measure_aspect(double aspect, bool quick, int bits) {
  constexpr double kWidthPx = 16, kLongestPx = 4096;
  Measured sums(coverage_methods().size());
  const double length = std::min(kWidthPx * aspect, kLongestPx);
  add_strips(sums, length, std::max(length / aspect, 1.0 / 256), strip_count(length, quick), kGrid, bits);
  return sums;
}

template <Grid kGrid>
Measured measure_height(double rows, bool quick, int bits) {
  constexpr double kWidthPx = 9;
  Measured sums(coverage_methods().size());
  add_strips(sums, rows, kWidthPx, strip_count(rows, quick), kGrid, bits);
  return sums;
}

// Squares of two right triangles at random places. The window is at their lower left corners, where values
// that accumulate down the rows have drifted most.
template <Grid kGrid>
Measured measure_legs(double legs, bool quick, int bits) {
  constexpr int kSide = 24, kBelow = 8;
  const auto leg = static_cast<float>(legs);
  Random random(1);
  const auto place = [&] { return static_cast<float>(on_grid(double{random.uniform(0, 1)}, kGrid)); };
  std::vector<FloatTriangle> triangles;
  for (int square = 0; square < (quick ? 512 : 4096); ++square) {
    const float x = place(), y = place();
    const glm::vec2 b(x + leg, y), c(x, y + leg);
    triangles.push_back(flat({{x, y}, b, c}));
    triangles.push_back(flat({{b.x, c.y}, c, b}));
  }
  Measured sums(coverage_methods().size());
  add_picture(sums, triangles, {kSide, kSide, 0, static_cast<int>(legs) + kBelow - kSide}, bits);
  return sums;
}

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

Measured measure_pan(double speed_px, bool quick, int bits) {
  const auto methods = coverage_methods();
  constexpr int kMargin = 16;
  constexpr Window window{64, 64, kMargin, kMargin};  // onto the middle of the mesh
  const int all = static_cast<int>(kMargin / speed_px), frames = quick ? std::min(128, all) : all;
  PixelChanges truth;
  std::vector<PixelChanges> changes(methods.size());
  std::vector<Run> runs;
  for (int frame = 0; frame < frames; ++frame) {
    const double way = frame * speed_px;
    const auto triangles = moved_mesh(window.width + 2 * kMargin, 1, kOffGrid, way, way / 2);
    const auto grid = snapped(triangles, bits);
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

}  // namespace

std::vector<Sweep> coverage_sweeps() {
  std::vector<Sweep> list{
      {"distance",
       Family::coverage,
       "a fine mesh on the 1/256 px grid, up to the far corner of the largest image",
       {"distance from origin", "px", true},
       kErrorsPerCrossing,
       2,
       powers_of_two(7, 14),
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
       3,
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
       {"superfluous changes per 10^6 true ones", true, 1e6},
       26,
       powers_of_two(-1, -10),
       measure_pan}};
  struct OffGrid {
    std::string_view of, name, summary;
    Measured (*measure)(double, bool, int);
  };
  constexpr OffGrid kOffGrids[] = {
      {"distance", "distance_off_grid",
       "a fine mesh with vertices anywhere, up to the far corner of the largest image",
       measure_distance<kOffGrid>},
      {"aspect", "aspect_off_grid", "slivers that share long edges, with vertices anywhere",
       measure_aspect<kOffGrid>},
      {"legs", "legs_off_grid", "right triangles with vertices anywhere, at the limits of 32-bit edge values",
       measure_legs<kOffGrid>},
      {"height", "height_off_grid", "long shared edges with vertices anywhere: accumulated values drift",
       measure_height<kOffGrid>}};
  for (const OffGrid& off : kOffGrids) {
    const auto on = std::ranges::find(list, off.of, &Sweep::name);
    Sweep sweep = *on;
    sweep.name = off.name, sweep.summary = off.summary, sweep.measure = off.measure;
    list.insert(on + 1, sweep);
  }
  return list;
}

}  // namespace edgewise::lab

// Coverage sweeps: distance from the origin, aspect, size and height of triangles.
#include "lab/sweeps/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "lab/coverage/cases.h"
#include "scene/streams.h"

namespace edgewise::lab {

Sweep make_sweep_distance();
Sweep make_sweep_aspect();
Sweep make_sweep_legs();
Sweep make_sweep_height();

void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window) {
  const auto grid = snapped(triangles);
  const CoverageInput input{triangles, grid};
  const CoverageTruth truth = float_coverage(input, window, 1);
  const std::uint64_t crossings = edge_crossings(triangles, window);
  const auto methods = coverage_methods();
  for (std::size_t i = 0; i < methods.size(); ++i)
    sums.methods[i] += {score_coverage(truth, methods[i], input).errors(), crossings};
  sums.by_snapping += score_coverage(truth, covered_runs(grid, window, 1), triangles, 0.0).errors();
}

float on_grid(double px, int steps_per_px) {
  return static_cast<float>(std::nearbyint(px * steps_per_px) / steps_per_px);
}

std::vector<FloatTriangle> moved_mesh(int side_px, double cell_px, std::uint64_t seed, int steps_per_px,
                                      double x, double y) {
  auto mesh = float_triangles(jittered_grid({.width = side_px, .height = side_px}, cell_px, seed));
  for (auto& [at, payload] : mesh)
    for (int i = 0; i < 3; ++i) {
      const auto place = [&](float px) {
        return double{steps_per_px > 0 ? on_grid(double{px}, steps_per_px) : px};
      };
      at.x_px[i] = static_cast<float>(place(at.x_px[i]) + x);
      at.y_px[i] = static_cast<float>(place(at.y_px[i]) + y);
    }
  return mesh;
}

namespace {

constexpr int kWindowPx = 96;

FloatTriangle flat(const glm::vec2 (&corner)[3]) {
  FloatTriangle t{{{}, {}, {0.5f, 0.5f, 0.5f}}, 1};
  for (int i = 0; i < 3; ++i) t.at.x_px[i] = corner[i].x, t.at.y_px[i] = corner[i].y;
  return t;
}

// An ulp is 1/256 px at 2^15 px and 1/8 px at 2^20 px, so vertices stay on the grid at every distance.
Measured measure_distance(double distance, bool quick) {
  Measured sums(coverage_methods().size());
  // Cells are so small that float products are exact near the origin.
  constexpr double kCellPx = 8;
  const int corner = static_cast<int>(distance);
  for (std::uint64_t seed = 1; seed <= (quick ? 4 : 64); ++seed)
    add_picture(sums, moved_mesh(kWindowPx, kCellPx, seed, 256, corner, corner),
                {kWindowPx, kWindowPx, corner, corner});
  return sums;
}

// Pairs of triangles side by side; each pair shares a long edge with the next.
struct Strip {
  double length_px, width_px;  // of a pair, along and across
  double skew_px;              // offset of the lower end across
  static constexpr int kPairs = 6;

  // Vertical strips, or horizontal ones (`lying`), mirrored at the image's diagonal.
  std::vector<FloatTriangle> triangles(bool lying, Random& random) const {
    const double left = 2.0 + double{random.uniform(0, 1)}, top = 1.0 + double{random.uniform(0, 1)};
    const auto corner = [&](int edge, bool low) {
      const double jitter = double{random.uniform(-0.2f, 0.2f)} * width_px;
      const float across = on_grid(left + edge * width_px + (low ? skew_px : 0.0) + jitter),
                  along = on_grid(top + (low ? length_px : 0.0));
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
void add_strips(Measured& sums, double length_px, double width_px, int count, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const Strip strip{length_px, width_px, double{random.uniform(0, 24)}};
    add_picture(sums, strip.triangles(false, random), {strip.width(), strip.height()});
    add_picture(sums, strip.triangles(true, random), {strip.height(), strip.width()});
    const double side = length_px * std::numbers::sqrt2 / 2;
    const Strip diagonal{side, width_px * std::numbers::sqrt2, side};
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
Measured measure_aspect(double aspect, bool quick) {
  constexpr double kWidthPx = 16, kLongestPx = 4096;
  Measured sums(coverage_methods().size());
  const double length = std::min(kWidthPx * aspect, kLongestPx);
  add_strips(sums, length, std::max(length / aspect, 1.0 / 256), strip_count(length, quick), 11);
  return sums;
}

Measured measure_height(double rows, bool quick) {
  constexpr double kWidthPx = 9;
  Measured sums(coverage_methods().size());
  add_strips(sums, rows, kWidthPx, strip_count(rows, quick), 12);
  return sums;
}

// Squares of two right triangles, at whole pixels and at a fractional offset, in three bands of rows.
Measured measure_legs(double legs, bool) {
  Measured sums(coverage_methods().size());
  constexpr int kRows = 24;
  const auto leg = static_cast<float>(legs);
  for (const glm::vec2 a : {glm::vec2(0.0f), glm::vec2(37.0f / 256, 101.0f / 256)}) {
    const glm::vec2 b = a + glm::vec2(leg, 0), c = a + glm::vec2(0, leg), d = a + glm::vec2(leg);
    for (const int band : {0, 1, 2})
      add_picture(sums, {flat({a, b, c}), flat({d, c, b})},
                  {static_cast<int>(legs) + 1, kRows, 0, static_cast<int>(legs - kRows) * band / 2});
  }
  return sums;
}

}  // namespace

Sweep make_sweep_distance() {
  return {"distance",
          Family::coverage,
          "a fine mesh on the 1/256 px grid, far from the origin",
          {"distance from origin", "px", true},
          kErrorsPerCrossing,
          4.5,
          powers_of_two(0, 20),
          measure_distance};
}

Sweep make_sweep_aspect() {
  return {"aspect",
          Family::coverage,
          "slivers that share long edges, on the 1/256 px grid",
          {"length over width", "", true},
          kErrorsPerCrossing,
          9,
          decades(0, 6),
          measure_aspect};
}

Sweep make_sweep_legs() {
  return {"legs",
          Family::coverage,
          "right triangles at the limits of 32-bit edge values",
          {"legs", "px", true},
          kErrorsPerCrossing,
          0.3,
          {64, 90, 128, 181, 182, 256, 362, 512, 724, 1024, 1448, 2048, 2896, 2897, 4096, 5792, 8192},
          measure_legs};
}

Sweep make_sweep_height() {
  return {"height",
          Family::coverage,
          "long shared edges, on the 1/256 px grid: accumulated values drift",
          {"length of the edges", "px", true},
          kErrorsPerCrossing,
          5,
          powers_of_two(3, 13),
          measure_height};
}

}  // namespace edgewise::lab

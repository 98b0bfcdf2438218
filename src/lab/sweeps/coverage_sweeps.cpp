// Coverage sweeps: distance from the origin, aspect, size and height of triangles, with vertices anywhere, at
// pixel centres and halves, and on our grid; and coverage in motion, where pixels flicker while a mesh moves
// slowly.
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

struct Swept {
  MethodInfo info;
  const CoverageMethod* method;
  int bits;  // of the snapped positions that it gets; 0: it gets none
};

// All backends draw the same pixels, so one stands for them.
const std::vector<Swept>& swept() {
  static const std::vector<Swept> list = [] {
    constexpr std::pair<std::string_view, int> kOurs[] = {{"ours_8", 8}, {"ours_12", 12}, {"ours_15", 15}};
    const CoverageMethod& backend = find_drawing_method("tiled");
    std::vector<Swept> all;
    for (const auto& [name, bits] : kOurs) {
      all.push_back({backend.info, &backend, bits});
      all.back().info.name = name;
    }
    for (const CoverageMethod& method : coverage_methods())
      if (!method.backend) all.push_back({method.info, &method, 0});
    return all;
  }();
  return list;
}

std::vector<ScreenTriangle> snapped_for(const Swept& swept, std::span<const FloatTriangle> triangles) {
  return swept.bits == 0 ? std::vector<ScreenTriangle>() : snapped(triangles, swept.bits);
}

// Adds each method's errors in a picture, against the float truth.
void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window) {
  const CoverageTruth truth = float_coverage({triangles, {}}, window, 1);
  const std::uint64_t crossings = edge_crossings(triangles, window);
  for (std::size_t i = 0; i < swept().size(); ++i) {
    const auto grid = snapped_for(swept()[i], triangles);
    sums.methods[i] +=
        {score_coverage(truth, {*swept()[i].method, {triangles, grid}, window}, triangles).errors(),
         crossings};
  }
}

// Vertices lie on multiples of 1/grid px: of halves at pixel centres, corners and between, as in user
// interfaces; of our grid where ours round nothing, so that all their errors would come from arithmetic.
constexpr int kAnywhere = 0, kOnHalves = 2, kOnOurGrid = Coarse::kSub;

double placed(double px, int grid) {
  return grid == kAnywhere ? px : std::nearbyint(px * grid) / grid;
}

// A jittered grid of cells of 8 px, so small that float products are exact near the origin. Places the
// vertices, and then moves them by (x, y) px.
std::vector<FloatTriangle> moved_mesh(int side_px, std::uint64_t seed, int grid, double x, double y) {
  auto mesh = float_triangles(jittered_grid({.width = side_px, .height = side_px}, 8.0, seed));
  for (auto& [at, payload] : mesh)
    for (int i = 0; i < 3; ++i) {
      at.x_px[i] = static_cast<float>(placed(double{at.x_px[i]}, grid) + x);
      at.y_px[i] = static_cast<float>(placed(double{at.y_px[i]}, grid) + y);
    }
  return mesh;
}

FloatTriangle flat(const glm::vec2 (&corner)[3]) {
  FloatTriangle t{{{}, {}, {0.5f, 0.5f, 0.5f}}, 1};
  for (int i = 0; i < 3; ++i) t.at.x_px[i] = corner[i].x, t.at.y_px[i] = corner[i].y;
  return t;
}

// The far corner of the mesh lies at this distance on both axes.
template <int kGrid>
Measured measure_distance(double distance, std::uint64_t seed) {
  Measured sums(swept().size());
  constexpr int kSide = 96;
  const int corner = static_cast<int>(distance) - kSide;
  add_picture(sums, moved_mesh(kSide, seed, kGrid, corner, corner), {kSide, kSide, corner, corner});
  return sums;
}

// Pairs of triangles side by side; each pair shares a long edge with the next.
struct Strip {
  double length_px, width_px;  // of a pair, along and across
  double skew_px;              // offset of the lower end across
  int grid;
  static constexpr int kPairs = 6;

  // Vertical strips, or horizontal ones (`lying`), mirrored at the image's diagonal.
  std::vector<FloatTriangle> triangles(bool lying, Random& random) const {
    const double left = 2.0 + double{random.uniform(0, 1)};
    // Each end jitters along the strip, too: one parallel to the rows of samples would err on all or none.
    const auto corner = [&](int edge, bool low) {
      const double jitter = double{random.uniform(-0.2f, 0.2f)} * width_px,
                   end = 1.0 + double{random.uniform(0, 1)};
      const auto across = static_cast<float>(
                     placed(left + edge * width_px + (low ? skew_px : 0.0) + jitter, grid)),
                 along = static_cast<float>(placed(end + (low ? length_px : 0.0), grid));
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
Measured measure_strips(double length_px, double width_px, std::uint64_t seed, int grid) {
  Measured sums(swept().size());
  Random random(seed);
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
  return sums;
}

// Strips 16 px wide with a length up to 4096 px; for higher aspects the width shrinks down to 1/256 px.
template <int kGrid>
Measured measure_aspect(double aspect, std::uint64_t seed) {
  constexpr double kWidthPx = 16, kLongestPx = 4096;
  const double length = std::min(kWidthPx * aspect, kLongestPx);
  return measure_strips(length, std::max(length / aspect, 1.0 / 256), seed, kGrid);
}

template <int kGrid>
Measured measure_height(double rows, std::uint64_t seed) {
  return measure_strips(rows, 9, seed, kGrid);
}

// Squares of two right triangles at random places. The window is at their lower left corners, where values
// that accumulate down the rows have drifted most.
template <int kGrid>
Measured measure_legs(double legs, std::uint64_t seed) {
  constexpr int kSide = 24, kBelow = 8;
  const auto leg = static_cast<float>(legs);
  Random random(seed);
  const auto place = [&] { return static_cast<float>(placed(double{random.uniform(0, kBelow)}, kGrid)); };
  std::vector<FloatTriangle> triangles;
  for (int square = 0; square < 512; ++square) {
    const float x = place(), y = place();
    const glm::vec2 b(x + leg, y), c(x, y + leg);
    triangles.push_back(flat({{x, y}, b, c}));
    triangles.push_back(flat({{b.x, c.y}, c, b}));
  }
  Measured sums(swept().size());
  add_picture(sums, triangles, {kSide, kSide, 0, static_cast<int>(legs) + kBelow - kSide});
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

Measured measure_pan(double speed_px, std::uint64_t seed) {
  constexpr int kMargin = 4;
  constexpr Window window{64, 64, kMargin, kMargin};  // onto the middle of the mesh
  PixelChanges truth;
  std::vector<PixelChanges> changes(swept().size());
  std::vector<Run> runs;
  for (int frame = 0; frame < static_cast<int>(kMargin / speed_px); ++frame) {
    const double way = frame * speed_px;
    const auto triangles = moved_mesh(window.width + 2 * kMargin, seed, kAnywhere, way, way / 2);
    truth.add(picture_of(covered_runs(triangles, window, 1), window));
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const auto grid = snapped_for(swept()[i], triangles);
      runs.clear();
      swept()[i].method->runs({triangles, grid}, window, runs);
      changes[i].add(picture_of(runs, window));
    }
  }
  Measured result(changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i)
    result.methods[i] = {changes[i].beyond(truth), truth.sum()};
  return result;
}

template <int kGrid>
void add_sweeps(std::vector<Sweep>& list, std::string_view (&&names)[4], std::string_view why) {
  const auto up_to = [](double most, std::vector<double> positions) {
    std::erase_if(positions, [most](double position) { return position > most; });
    return positions;
  };
  list.push_back({names[0],
                  Family::coverage,
                  "a fine mesh, up to the far corner of the largest image",
                  {"distance from origin", "px"},
                  powers_of_two(7, 14),
                  measure_distance<kGrid>,
                  why});
  list.push_back({names[1],
                  Family::coverage,
                  "slivers that share long edges",
                  {"length over width", ""},
                  up_to(kGrid == kOnHalves ? 2000 : 1e6, decades(0, 6)),  // thinner ones lose their area
                  measure_aspect<kGrid>,
                  why});
  list.push_back({names[2],
                  Family::coverage,
                  "right triangles, at the limits of 32-bit edge values",
                  {"legs", "px"},
                  {64, 90, 128, 181, 182, 256, 362, 512, 724, 1024, 1448, 2048, 2896, 2897, 4096, 5792, 8192},
                  measure_legs<kGrid>,
                  why});
  list.push_back({names[3],
                  Family::coverage,
                  "long shared edges: accumulated values drift",
                  {"length of the edges", "px"},
                  powers_of_two(3, 13),
                  measure_height<kGrid>,
                  why});
}

}  // namespace

std::vector<MethodInfo> swept_coverage_methods() {
  return infos_of(swept());
}

std::vector<Sweep> coverage_sweeps() {
  constexpr std::string_view kRounding = "8 bits move a vertex by up to 1/512 px, 12 bits by 1/8192 px";
  std::vector<Sweep> list;
  add_sweeps<kAnywhere>(list, {"distance", "aspect", "legs", "height"}, kRounding);
  list.push_back({"pan",
                  Family::coverage,
                  "a mesh pans slowly: pixels that change though the truth does not",
                  {"speed", "px per frame"},
                  powers_of_two(-1, -8),
                  measure_pan,
                  kRounding});
  add_sweeps<kOnHalves>(list,
                        {"distance_on_halves", "aspect_on_halves", "legs_on_halves", "height_on_halves"}, "");
  add_sweeps<kOnOurGrid>(
      list, {"distance_on_our_grid", "aspect_on_our_grid", "legs_on_our_grid", "height_on_our_grid"}, "");
  return list;
}

}  // namespace edgewise::lab

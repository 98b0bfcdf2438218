#include "lab/coverage/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "edgewise/builtin.h"
#include "scene/streams.h"

namespace edgewise::lab {

namespace {

struct Point {
  float x, y;
};
using Triangles = std::vector<FloatTriangle>;

FloatTriangle triangle(Point a, Point b, Point c, std::uint32_t payload) {
  return {{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {0.5f, 0.5f, 0.5f}}, payload};
}

// Triangles of one depth, numbered from 1.
Triangles numbered(std::initializer_list<std::array<Point, 3>> corners) {
  Triangles list;
  for (const auto& [a, b, c] : corners)
    list.push_back(triangle(a, b, c, static_cast<std::uint32_t>(list.size() + 1)));
  return list;
}

// From the issues of facebookresearch/DRTK, moved by half a pixel, since DRTK has its samples at whole
// pixels.
Triangles drtk_quad() {
  const Point p[4] = {{1.0f, 0.99993896484375f},
                      {1.0f, 7.0f},
                      {7.00006103515625f, 0.99993896484375f},
                      {7.00006103515625f, 7.0f}};
  return numbered({{p[0], p[1], p[2]}, {p[3], p[2], p[1]}});
}

Triangles lattice_square() {
  const Point a{0, 0}, b{64, 0}, c{64, 64}, d{0, 64};
  return numbered({{a, b, c}, {a, c, d}});
}

// A fan around a point: long edges in all directions. Covers every pixel once.
Triangles fan() {
  constexpr int kSpokes = 480;
  constexpr float kWidth = 1920, kHeight = 1080;
  constexpr Point kHub{877.3141f, 571.8282f};
  Random random(42);
  std::vector<Point> rim{{0, 0}, {kWidth, 0}, {0, kHeight}, {kWidth, kHeight}};
  for (int i = 0; i < kSpokes; ++i) {
    const float along = random.uniform(0.0f, 1.0f);
    const int side = i % 4;
    rim.push_back(side < 2 ? Point{along * kWidth, side == 0 ? 0.0f : kHeight}
                           : Point{side == 2 ? 0.0f : kWidth, along * kHeight});
  }
  std::sort(rim.begin(), rim.end(), [&](Point a, Point b) {
    const bool a_low = a.y > kHub.y, b_low = b.y > kHub.y;
    if (a_low != b_low) return b_low;
    return (a.x - kHub.x) * (b.y - kHub.y) - (a.y - kHub.y) * (b.x - kHub.x) > 0;
  });
  Triangles list;
  for (std::size_t i = 0; i < rim.size(); ++i)
    list.push_back(triangle(kHub, rim[i], rim[(i + 1) % rim.size()], static_cast<std::uint32_t>(i + 1)));
  return list;
}

Triangles mesh() {
  return float_triangles(jittered_grid({.width = 1920, .height = 1080}, 24.0, 7));
}

// Both truths agree here, so that all errors come from arithmetic or the fill rule. Every fourth vertex lies
// on a sample, as vertices of tile maps and user interfaces do.
Triangles mesh_on_grid() {
  auto stream = jittered_grid({.width = 1920, .height = 1080}, 24.0, 7);
  const auto on_grid = [](float v) { return std::nearbyint(v * 256.0f) / 256.0f; };
  const auto on_sample = [](float v) { return std::floor(v) + 0.5f; };
  for (auto& t : stream.triangles)
    for (auto& v : t.vertex) {
      const bool inner = v.x > 0 && v.y > 0 && v.x < 1920 && v.y < 1080;
      const bool fourth = static_cast<int>(v.x + v.y) % 4 == 0;
      v.x = inner && fourth ? on_sample(v.x) : on_grid(v.x);
      v.y = inner && fourth ? on_sample(v.y) : on_grid(v.y);
    }
  return float_triangles(stream);
}

Triangles tall_slivers() {
  const Point top{31.3f, 0.0f}, bottom{33.1f, 1080.0f};
  return numbered({{top, bottom, {29.9f, 541.7f}}, {top, {34.2f, 533.1f}, bottom}});
}

Triangles legs(float px) {
  return numbered({{Point{0, 0}, {px, 0}, {0, px}}});
}

// The lower triangle's edge runs through 200 samples. The upper triangles share a vertex that lies exactly on
// that edge. Its y is 1/512 px off the grid, so snapping moves it off the edge.
Triangles t_junction(bool split) {
  const Point from{0.5f, 10.5f}, to{400.5f, 210.5f}, on_edge{200.5f + 1.0f / 256, 110.5f + 1.0f / 512};
  const Point above{400.5f, 10.5f}, below{0.5f, 210.5f};
  auto list = numbered({{from, above, on_edge}, {on_edge, above, to}});
  if (split) {
    list.push_back(triangle(from, on_edge, below, 3));
    list.push_back(triangle(on_edge, to, below, 4));
  } else {
    list.push_back(triangle(from, to, below, 3));
  }
  return list;
}

// Cells of 0.7 px: rounding to whole pixels removes or flips many triangles.
Triangles small_triangles() {
  return float_triangles(jittered_grid({.width = 64, .height = 64}, 0.7, 3));
}

// A corner so near to (0, 0) that its difference to the samples rounds it away even in double. All samples on
// the diagonal lie beside the edge, by less than a double can resolve.
Triangles double_tie() {
  const Point corner{1e-30f, 0.0f}, far{64, 64};
  return numbered({{corner, {64, 0}, far}, {corner, far, {0, 64}}});
}

}  // namespace

std::span<const CoverageCase> coverage_cases() {
  static constexpr std::array kCases{
      CoverageCase{"drtk_quad", "two triangles whose diagonal runs through six samples", {8, 8}, drtk_quad},
      CoverageCase{
          "lattice_square", "a square on whole pixels: 64 samples on its diagonal", {64, 64}, lattice_square},
      CoverageCase{"fan",
                   "long edges in all directions: floats round them differently from both ends",
                   {1920, 1080},
                   fan},
      CoverageCase{"mesh_on_grid",
                   "a mesh on the 1/256 px grid, a quarter of its vertices on samples",
                   {1920, 1080},
                   mesh_on_grid},
      CoverageCase{"mesh", "an unsnapped mesh that covers every pixel once", {1920, 1080}, mesh},
      CoverageCase{"tall_slivers",
                   "two slivers that share an edge of 1080 px: drift from row to row",
                   {64, 1080},
                   tall_slivers},
      CoverageCase{"legs_181",
                   "the largest right triangle whose edge values fit 32 bits",
                   {200, 200},
                   [] { return legs(181); }},
      CoverageCase{"legs_182", "one pixel more: 32 bits wrap", {200, 200}, [] { return legs(182); }},
      CoverageCase{"t_junction",
                   "a vertex on a neighbour's edge: a crack in every backend",
                   {401, 221},
                   [] { return t_junction(false); }},
      CoverageCase{"t_junction_split",
                   "the same with the edge split: no crack",
                   {401, 221},
                   [] { return t_junction(true); }},
      CoverageCase{"small_triangles",
                   "triangles below a pixel: whole-pixel vertices lose or flip them",
                   {64, 64},
                   small_triangles},
      CoverageCase{"double_tie",
                   "an edge that misses its samples by less than a double can tell",
                   {64, 64},
                   double_tie}};
  return kCases;
}

std::vector<FloatTriangle> float_triangles(const TriangleStream& stream) {
  std::vector<FloatTriangle> list;
  list.reserve(stream.triangles.size());
  for (const auto& t : stream.triangles) {
    FloatTriangle& to = list.emplace_back();
    for (int i = 0; i < 3; ++i)
      to.at.x_px[i] = t.vertex[i].x, to.at.y_px[i] = t.vertex[i].y, to.at.z01[i] = t.vertex[i].z;
    to.payload = t.colour;
  }
  return list;
}

}  // namespace edgewise::lab

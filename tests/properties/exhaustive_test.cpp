// All triangles, in every orientation, whose vertices lie on a small lattice of sub-units inside a few
// pixels: compares every backend on every SIMD target with the oracle's depths and ids. Thousands share a
// frame, one per cell.
#include <gtest/gtest.h>

#include <ostream>
#include <string_view>
#include <vector>

#include "frontend/fixed.h"
#include "lab/cases/to_stream.h"
#include "lab/truth/oracle.h"
#include "properties/pictures.h"
#include "properties/streams.h"
#include "support.h"

namespace edgewise::testing {
namespace {

// x and y of a vertex, in sub-units, are any two of `coordinates`.
struct Lattice {
  std::string name;
  std::vector<std::int32_t> coordinates;

  std::uint64_t points() const { return coordinates.size() * coordinates.size(); }
  std::uint64_t triangles() const { return points() * points() * points(); }  // each vertex is any point
  friend std::ostream& operator<<(std::ostream& out, const Lattice& lattice) { return out << lattice.name; }
};

Lattice steps(std::string name, int px, int steps_per_px) {
  Lattice lattice{std::move(name), {}};
  for (int i = 0; i <= px * steps_per_px; ++i)
    lattice.coordinates.push_back(i * contract::kPixel_q15 / steps_per_px);
  return lattice;
}

// The samples of consecutive pixels, and the positions one sub-unit before and after them.
Lattice around_samples(int px) {
  Lattice lattice{"around_samples", {}};
  for (int i = 0; i < px; ++i)
    for (const int off : {-128, 0, 128}) lattice.coordinates.push_back(contract::sample_q15(i) + off);
  return lattice;
}

// An odd cell size, so that cells fall on all SIMD lanes and across all borders of tiles.
constexpr int kCellPx = 5, kCellsASide = 128, kSidePx = kCellPx * kCellsASide;
constexpr std::uint64_t kCells = std::uint64_t{kCellsASide} * kCellsASide;

ScreenTriangle triangle_of(const Lattice& lattice, std::uint64_t number, std::uint32_t cell) {
  ScreenTriangle t{};
  Random depths(number);
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t point = number % lattice.points(), side = lattice.coordinates.size();
    number /= lattice.points();
    const auto origin = [](std::uint32_t c) {
      return static_cast<std::int32_t>(c) * kCellPx * contract::kPixel_q15;
    };
    t.x_q15[i] = origin(cell % kCellsASide) + lattice.coordinates[point % side];
    t.y_q15[i] = origin(cell / kCellsASide) + lattice.coordinates[point / side];
    t.z[i] = quantize_depth(static_cast<float>(depths.below(1 << 16)) * 0x1p-16f);  // a stream can hold it
  }
  t.payload = cell;
  return t;
}

// Every target, and the other tile sizes.
std::vector<lab::DrawOptions> all_targets() {
  std::vector<lab::DrawOptions> ways;
  for (const SimdTarget target : supported_targets()) ways.push_back({{1, 64, target}});
  ways.push_back({{1, 16, SimdTarget::best}});
  ways.push_back({{2, 32, SimdTarget::best}});
  return ways;
}

// Reduces triangles that are drawn wrong to those at the first wrong pixel if these alone are drawn wrong
// too; otherwise keeps all.
Counterexample narrowed(const std::vector<ScreenTriangle>& triangles, const Framebuffer& wrong, int x, int y,
                        const Property& property) {
  std::vector<ScreenTriangle> suspects;
  const auto at_pixel = static_cast<std::uint32_t>(y / kCellPx * kCellsASide + x / kCellPx);
  for (const std::uint32_t cell : {at_pixel, wrong.payload_row(y)[x]})
    if (cell < triangles.size()) suspects.push_back(triangles[cell]);
  const TriangleStream few = lab::to_stream(suspects, kSidePx, kSidePx);
  if (!property(few).wrong.empty()) return smallest(shrinkable(few), property);
  return {property(lab::to_stream(triangles, kSidePx, kSidePx)), 0};
}

// Stops at the first difference. Counts the triangles drawn, over all backends and executions.
SearchResult draw_all(const Lattice& lattice, const std::vector<Painter>& painters,
                      const std::vector<lab::DrawOptions>& ways) {
  SearchResult result;
  Framebuffer expected(kSidePx, kSidePx), actual(kSidePx, kSidePx);
  std::vector<ScreenTriangle> triangles;
  for (std::uint64_t first = 0; first < lattice.triangles(); first += triangles.size()) {
    triangles.clear();
    for (std::uint64_t i = first; i < std::min(first + kCells, lattice.triangles()); ++i)
      triangles.push_back(triangle_of(lattice, i, static_cast<std::uint32_t>(i - first)));
    result.cases += triangles.size();
    lab::draw_oracle(triangles, expected, kBackground);
    for (const Painter& painter : painters)
      for (const lab::DrawOptions& way : ways) {
        lab::poison(actual);
        painter.with(way.tiles).draw(triangles, actual.view(), {kBackground}, way.execution);
        result.comparisons += triangles.size();
        const auto difference = lab::compare(expected, actual);
        if (difference.pixels == 0) continue;
        result.found = narrowed(triangles, actual, difference.first_x, difference.first_y,
                                like_the_oracles(painters, {way}));
        return result;
      }
  }
  return result;
}

class EveryTriangle : public ::testing::TestWithParam<Lattice> {};

TEST_P(EveryTriangle, OnTheLatticeMatchesTheOracle) {
  const SearchResult result = draw_all(GetParam(), painters(backends()), all_targets());
  RecordProperty("cases", std::to_string(result.cases));
  RecordProperty("comparisons", std::to_string(result.comparisons));
  if (result.found) fail(*result.found);
  EXPECT_EQ(result.cases, GetParam().triangles());
}

std::vector<Lattice> lattices() {
  if (full_size())
    return {steps("eighths_of_2_px", 2, 8), steps("quarters_of_4_px", 4, 4), around_samples(4)};
  return {steps("quarters_of_2_px", 2, 4), steps("halves_of_4_px", 4, 2), around_samples(2)};
}

INSTANTIATE_TEST_SUITE_P(Lattices, EveryTriangle, ::testing::ValuesIn(lattices()),
                         [](const auto& lattice) { return lattice.param.name; });

}  // namespace
}  // namespace edgewise::testing

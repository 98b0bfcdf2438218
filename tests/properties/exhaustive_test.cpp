// All triangles, in every orientation, whose vertices lie on a small lattice of sub-units inside a few
// pixels: compares every backend on every SIMD target with the oracle's depths and ids. Thousands share a
// frame, one per cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "frontend/fixed.h"
#include "lab/truth/oracle.h"
#include "support.h"

namespace edgewise::testing {
namespace {

// x and y of a vertex, in sub-units, are any two of `coordinates`.
struct Lattice {
  std::string name;
  std::vector<std::int32_t> coordinates;

  std::uint64_t points() const { return coordinates.size() * coordinates.size(); }
  std::uint64_t triangles() const { return points() * points() * points(); }  // each vertex is any point
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

class EveryTriangle : public ::testing::TestWithParam<Lattice> {};

TEST_P(EveryTriangle, OnTheLatticeMatchesTheOracle) {
  const Lattice& lattice = GetParam();
  const auto ways = all_targets();
  lab::BackendCache made;
  Framebuffer expected(kSidePx, kSidePx), actual(kSidePx, kSidePx);
  std::vector<ScreenTriangle> triangles;
  std::uint64_t comparisons = 0;
  for (std::uint64_t first = 0; first < lattice.triangles() && !HasFailure(); first += triangles.size()) {
    triangles.clear();
    for (std::uint64_t i = first; i < std::min(first + kCells, lattice.triangles()); ++i)
      triangles.push_back(triangle_of(lattice, i, static_cast<std::uint32_t>(i - first)));
    lab::draw_oracle(triangles, expected, kBackground);
    for (const BackendInfo& info : backends())
      for (const lab::DrawOptions& way : ways) {
        lab::poison(actual);
        made.get(info, way.tiles).draw(triangles, actual.view(), {kBackground}, way.execution);
        comparisons += triangles.size();
        expect_same(
            expected, actual,
            std::string(info.name) + ", " + describe(way) + ", triangles from " + std::to_string(first));
      }
  }
  RecordProperty("cases", std::to_string(lattice.triangles()));
  RecordProperty("comparisons", std::to_string(comparisons));
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

#include "raster/shares.h"

#include <algorithm>
#include <numeric>

#include "edgewise/contract.h"
#include "raster/patch.h"

namespace edgewise {

namespace {

// How long binning takes a triangle. In units of a pixel that a small one's box holds (about 0.3 ns on Zen
// 5); a mesh whose triangles grow from 6 to 25 px takes 1.6 times as long at its end as at its beginning.
std::uint32_t weight(const ScreenTriangle& triangle, const CellGrid& grid) {
  constexpr std::uint32_t kTriangle = 16, kCell = 4;
  const contract::PixelBox box = contract::pixel_box(triangle, grid.width, grid.height);
  if (box.empty()) return kTriangle;
  const int width = box.x1 - box.x0, height = box.y1 - box.y0;
  if (std::max(width, height) <= kPatchSide)
    return kTriangle + static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(height);
  const int columns = ((box.x1 - 1) >> grid.cell_w_log2) - (box.x0 >> grid.cell_w_log2) + 1;
  const int rows = ((box.y1 - 1) >> grid.cell_h_log2) - (box.y0 >> grid.cell_h_log2) + 1;
  return kTriangle + kCell * static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
}

}  // namespace

void Shares::cut(std::span<const ScreenTriangle> triangles, const CellGrid& grid, std::size_t parts) {
  // To look at the samples takes some 10 us a part; to bin as many triangles, 1 ms and more. Equal parts of
  // random triangles differ by less than a twentieth in nearly all draws of so many.
  constexpr std::size_t kWorthLooking = 200'000, kSamples = 512, kTolerance = 20;
  bounds_.resize(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) bounds_[i] = triangles.size() * i / parts;
  if (parts < 2 || triangles.size() / parts < kWorthLooking) return;

  const std::size_t count = parts * kSamples;
  const auto place = [&](std::size_t sample) { return triangles.size() * sample / count; };
  weights_.resize(count);
  for (std::size_t i = 0; i < count; ++i) weights_[i] = weight(triangles[place(i)], grid);
  const auto sum = [&](std::size_t first, std::size_t samples) {
    const auto begin = weights_.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(samples), std::uint64_t{0});
  };
  const std::uint64_t total = sum(0, count);
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < parts; ++i) most = std::max(most, sum(i * kSamples, kSamples));
  if (most * parts <= total + total / kTolerance) return;

  std::uint64_t before = 0;
  for (std::size_t i = 0, part = 1; i < count; ++i) {
    before += weights_[i];
    for (; part < parts && before * parts >= total * part; ++part) bounds_[part] = place(i + 1);
  }
}

}  // namespace edgewise

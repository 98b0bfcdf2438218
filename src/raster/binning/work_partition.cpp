#include "raster/binning/work_partition.h"

#include <algorithm>
#include <numeric>

#include "edgewise/contract.h"
#include "raster/binning/coverage_mask.h"

namespace edgewise {

namespace {

// How long it takes to bin a triangle, in units of a pixel that a small one's box holds (0.3 ns on Zen 5): in
// a mesh whose triangles grow towards the eye, 1.6 times as long for the nearest as for the farthest. Large
// ones in many cells take longer than is said here, but then drawing them takes much longer than binning.
std::uint32_t work(const ScreenTriangle& triangle, int width, int height) {
  constexpr std::uint32_t kTriangle = 16;
  const contract::PixelBox box = contract::pixel_box(triangle, width, height);
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  if (box.empty() || std::max(columns, rows) > kMaskSide) return kTriangle;
  return kTriangle + static_cast<std::uint32_t>(columns * rows);
}

}  // namespace

void WorkPartition::cut_equally(std::size_t count, std::size_t parts) {
  bounds_.resize(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) bounds_[i] = count * i / parts;
}

void WorkPartition::cut_by_work(std::span<const ScreenTriangle> triangles, int width, int height,
                                std::size_t parts) {
  cut_equally(triangles.size(), parts);
  // To look at its samples takes some 10 us a part, one part after the other: at most a hundredth of what it
  // takes to bin one. Parts of triangles in random order differ by less than a tenth of their work in nearly
  // all draws of so many samples.
  constexpr std::size_t kWorthLooking = 100'000, kSamples = 512, kTolerance = 10;
  if (parts < 2 || triangles.size() / parts < kWorthLooking * parts) return;

  const std::size_t count = parts * kSamples;
  const auto place = [&](std::size_t sample) { return triangles.size() * sample / count; };
  work_.resize(count);
  for (std::size_t i = 0; i < count; ++i) work_[i] = work(triangles[place(i)], width, height);
  const auto sum = [&](std::size_t first, std::size_t samples) {
    const auto begin = work_.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(samples), std::size_t{0});
  };
  const std::size_t total = sum(0, count);
  std::size_t most = 0;
  for (std::size_t i = 0; i < parts; ++i) most = std::max(most, sum(i * kSamples, kSamples));
  if (most * parts <= total + total / kTolerance) return;

  std::size_t before = 0;
  for (std::size_t i = 0, part = 1; i < count; ++i) {
    before += work_[i];
    for (; part < parts && before * parts >= total * part; ++part) bounds_[part] = place(i + 1);
  }
}

}  // namespace edgewise

#include "raster/binning/work_partition.h"

#include <algorithm>
#include <numeric>

#include "edgewise/contract.h"
#include "raster/binning/coverage_mask.h"

namespace edgewise {

namespace {

// Cost model of binning a triangle. The unit is the time per pixel of a small triangle's box (0.3 ns on Zen
// 5). In a mesh whose triangles grow towards the camera, the nearest cost 1.6 times as much as the farthest.
// The model underestimates large triangles in many cells, where drawing takes much longer than binning
// anyway.
std::uint32_t work(const ScreenTriangle& triangle, int width, int height) {
  constexpr std::uint32_t kWorkPerTriangle = 16;
  const contract::PixelBox box = contract::pixel_box(triangle, width, height);
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  if (box.empty() || std::max(columns, rows) > kMaskSide) return kWorkPerTriangle;
  return kWorkPerTriangle + static_cast<std::uint32_t>(columns * rows);
}

}  // namespace

void WorkPartition::cut_equally(std::size_t count, std::size_t parts) {
  bounds_.resize(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) bounds_[i] = count * i / parts;
}

void WorkPartition::cut_by_work(std::span<const ScreenTriangle> triangles, int width, int height,
                                std::size_t parts) {
  cut_equally(triangles.size(), parts);
  // Evaluating the samples takes about 10 us per part, one part after the other. From kMinPerPart triangles
  // per part, times the number of parts, that is at most 1 % of the time to bin a part. Parts of triangles in
  // random order differ by less than 1 / kTolerance of their work in nearly all draws of kSamples per part.
  constexpr std::size_t kMinPerPart = 100'000, kSamples = 512, kTolerance = 10;
  if (parts < 2 || triangles.size() / parts < kMinPerPart * parts) return;

  const std::size_t count = parts * kSamples;
  const auto sample_index = [&](std::size_t sample) { return triangles.size() * sample / count; };
  work_.resize(count);
  for (std::size_t i = 0; i < count; ++i) work_[i] = work(triangles[sample_index(i)], width, height);
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
    for (; part < parts && before * parts >= total * part; ++part) bounds_[part] = sample_index(i + 1);
  }
}

}  // namespace edgewise

#include "raster/binning/work_partition.h"

#include <algorithm>
#include <numeric>

#include "edgewise/contract.h"
#include "raster/binning/coverage_mask.h"

namespace edgewise {

namespace {

// Cost model of an input and of binning its triangles. The unit is the time per pixel of a small triangle's
// box (0.3 ns on Zen 5). In a mesh whose triangles grow towards the camera, the nearest cost 1.6 times as
// much as the farthest. The model underestimates large triangles in many cells, where drawing takes much
// longer than binning anyway.
constexpr std::uint32_t kWorkPerInput = 8, kWorkPerTriangle = 8;

std::uint32_t work(const ScreenTriangle& triangle, int width, int height, bool masks) {
  const contract::PixelBox box = contract::pixel_box(triangle, width, height);
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  if (!masks || box.empty() || std::max(columns, rows) > kMaskSide) return kWorkPerTriangle;
  return kWorkPerTriangle + static_cast<std::uint32_t>(columns * rows);
}

}  // namespace

void WorkPartition::cut_equally(std::size_t count, std::size_t parts) {
  bounds_.resize(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) bounds_[i] = count * i / parts;
}

void WorkPartition::cut_by_work(TriangleSource& source, int width, int height, bool masks,
                                std::size_t parts) {
  cut_equally(source.size(), parts);
  // Evaluating the samples takes about 10 us per part, or 50 us if triangles are made, one part after the
  // other. From kMinPerPart inputs per part, times the number of parts, that is at most 1 % of the time to
  // bin a part, or 3 % of the time to make and bin it. Parts of triangles in random order differ by less than
  // 1 / kTolerance of their work in nearly all draws of kSamples per part.
  constexpr std::size_t kMinPerPart = 100'000, kSamples = 512, kTolerance = 10;
  if (parts < 2 || source.size() / parts < kMinPerPart * parts) return;

  const std::size_t count = parts * kSamples;
  const auto sample_index = [&](std::size_t sample) { return source.size() * sample / count; };
  work_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    work_[i] = kWorkPerInput;
    for (const ScreenTriangle& t : source.sample(sample_index(i))) work_[i] += work(t, width, height, masks);
  }
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

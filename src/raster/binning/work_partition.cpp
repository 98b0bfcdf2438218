#include "raster/binning/work_partition.h"

#include <algorithm>
#include <numeric>

#include "edgewise/contract.h"
#include "raster/binning/mask_lists.h"

namespace edgewise {

namespace {

// Cost model of an input and of binning its triangles. The unit is the time per pixel of a small triangle's
// box (0.3 ns on Zen 5). In a mesh whose triangles grow towards the camera, the nearest cost 1.6 times as
// much as the farthest. The model underestimates large triangles in many cells, where drawing takes much
// longer than binning anyway.
constexpr std::uint32_t kWorkPerInput = 8, kWorkPerTriangle = 8;

std::uint32_t work(const ScreenTriangle& triangle, const CellGrid& grid, bool masks) {
  const contract::PixelBox box = box_in(grid, triangle);
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  if (!masks || box.empty() || std::max(columns, rows) > kMaskSide) return kWorkPerTriangle;
  return kWorkPerTriangle + static_cast<std::uint32_t>(columns * rows);
}

}  // namespace

void WorkPartition::cut_equally(std::size_t count, std::size_t slices) {
  bounds_.resize(slices + 1);
  for (std::size_t i = 0; i <= slices; ++i) bounds_[i] = count * i / slices;
}

void WorkPartition::cut_by_work(TriangleSource& source, const CellGrid& grid, bool masks,
                                std::size_t slices) {
  cut_equally(source.size(), slices);
  // Evaluating the probes takes about 10 us per slice, or 50 us if triangles are made, one slice after the
  // other. From kMinPerSlice inputs per slice, times the number of slices, that is at most 1 % of the time to
  // bin a slice, or 3 % of the time to make and bin it. Slices of triangles in random order differ by less
  // than 1 / kTolerance of their work in nearly all draws of kProbes per slice.
  constexpr std::size_t kMinPerSlice = 100'000, kProbes = 512, kTolerance = 10;
  if (slices < 2 || source.size() / slices < kMinPerSlice * slices) return;

  const std::size_t count = slices * kProbes;
  const auto probe_index = [&](std::size_t probe) { return source.size() * probe / count; };
  work_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    work_[i] = kWorkPerInput;
    for (const ScreenTriangle& t : source.probe(probe_index(i))) work_[i] += work(t, grid, masks);
  }
  const auto sum = [&](std::size_t first, std::size_t probes) {
    const auto begin = work_.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(probes), std::size_t{0});
  };
  const std::size_t total = sum(0, count);
  std::size_t most = 0;
  for (std::size_t i = 0; i < slices; ++i) most = std::max(most, sum(i * kProbes, kProbes));
  if (most * slices <= total + total / kTolerance) return;

  std::size_t before = 0;
  for (std::size_t i = 0, slice = 1; i < count; ++i) {
    before += work_[i];
    for (; slice < slices && before * slices >= total * slice; ++slice) bounds_[slice] = probe_index(i + 1);
  }
}

}  // namespace edgewise

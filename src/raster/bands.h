// Drawing in horizontal bands, for a backend without tiles. On one thread, the whole image is one band. On
// several threads, triangles are binned to bands, which are drawn in parallel.
#pragma once

#include <algorithm>
#include <span>

#include "core/parallel.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "raster/binning/bins.h"

namespace edgewise {

struct RowRange {
  int begin, end;
};

inline void clear_rows(FrameView frame, RowRange rows, std::uint32_t background) {
  for (int y = rows.begin; y < rows.end; ++y) {
    std::fill_n(frame.depth + y * frame.stride, frame.width, contract::kDepthClear);
    std::fill_n(frame.payload + y * frame.stride, frame.width, background);
  }
}

// Clears the frame. Calls draw(triangle, rows) for every band and every triangle that may cover a sample in
// it, in submission order.
template <typename Draw>
void draw_in_bands(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution, Bins& bins, Draw&& draw) {
  if (execution.threads == 1) {
    const RowRange all{0, frame.height};
    clear_rows(frame, all, background);
    for (const auto& triangle : triangles) draw(triangle, all);
    return;
  }
  constexpr int kBandRowsLog2 = 5, kWholeWidthLog2 = 14;
  static_assert(1 << kWholeWidthLog2 == contract::kMaxImageSide);
  const CellGrid grid{frame.width, frame.height, kWholeWidthLog2, kBandRowsLog2};
  bins.build(triangles, grid, execution.threads, execution.target, Bins::Small::as_indices, true);
  parallel_for(execution.threads, grid.rows(), [&](int band) {
    const RowRange rows{band << kBandRowsLog2, std::min((band + 1) << kBandRowsLog2, frame.height)};
    clear_rows(frame, rows, background);
    bins.for_each_segment(band, [&](const Bins::Segment& segment) {
      for (const std::uint32_t index : segment.indices) draw(triangles[index], rows);
    });
  });
}

}  // namespace edgewise

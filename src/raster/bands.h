// Drawing in horizontal bands, for backends without tiles: a band's rows are drawn in the frame itself.
#pragma once

#include <algorithm>

#include "core/parallel.h"
#include "core/triangle_source.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "raster/binning/bins.h"
#include "raster/tile_list.h"

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

// So few that a band of 1920 px, of 480 KB, stays in L2 from its clear to its last triangle. A depth cell's
// height is a multiple of it, so a band lies in one row of depth cells (rule 6).
inline constexpr int kBandRowsLog2 = 5;
static_assert(contract::kDepthCell % (1 << kBandRowsLog2) == 0);

// Bins triangles to bands, and calls draw(band, rows) for each band, in parallel. Band i's triangles are
// those of cell i in `bins`. Returns false if Bins::build() does; then nothing is drawn.
template <typename Draw>
bool draw_in_bands(TriangleSource& triangles, FrameView frame, const Execution& execution, Bins& bins,
                   Draw&& draw) {
  constexpr int kWholeWidthLog2 = 14;
  static_assert(1 << kWholeWidthLog2 == contract::kMaxImageSide);
  const CellGrid grid{frame.width, frame.height, kWholeWidthLog2, kBandRowsLog2};
  if (!bins.build(triangles, grid, execution.threads, execution.target, Bins::Small::as_indices))
    return false;
  parallel_for(execution.threads, grid.rows(), [&](int band) {
    draw(band, RowRange{band << kBandRowsLog2, std::min((band + 1) << kBandRowsLog2, frame.height)});
  });
  return true;
}

inline constexpr int kLongestVector = 16;  // px

// The task of drawing the triangles of a cell in a part of the frame that is clear: a band, or rows of a
// tile.
struct BandTask {
  const Bins& bins;
  int cell;
  // Begins at a multiple of kLongestVector, and is at least that wide. Its rows lie in one row of depth
  // cells.
  contract::PixelBox area;
  FrameView frame;
};
using BandKernel = void (*)(const BandTask&);

// `target` must be resolved.
BandKernel scanline_kernel(SimdTarget target);
// Draws all triangles by spans: better where they are few.
BandKernel span_kernel(SimdTarget target);

// A backend whose kernels draw one band.
class BandBackend : public Backend {
 public:
  explicit BandBackend(BandKernel (*kernel_for)(SimdTarget)) : kernel_for_(kernel_for) {}

 private:
  bool draw_source(TriangleSource& triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) final {
    // Each vector of pixels lies in the frame, which must be as wide as the longest vector.
    const BandKernel kernel =
        kernel_for_(frame.width < kLongestVector ? SimdTarget::scalar : execution.target);
    const ClearKernel clear = clear_kernel(execution.target);
    return draw_in_bands(triangles, frame, execution, bins_, [&](int band, RowRange rows) {
      // A span of tiles of one pixel, as wide as any image.
      constexpr TileSpan kWholeWidth{0, contract::kMaxImageSide};
      clear({{&kWholeWidth, 1}, rows.begin, rows.end, 0, frame, background, false});
      kernel({bins_, band, {0, rows.begin, frame.width, rows.end}, frame});
    });
  }
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) final {
    StoredTriangles stored(triangles);
    draw_source(stored, frame, background, execution);  // always true: stored triangles are not copied
  }

  BandKernel (*const kernel_for_)(SimdTarget);
  Bins bins_;
};

}  // namespace edgewise

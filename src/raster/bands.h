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

// Clears rows of a part, unless part.clear is false.
inline void clear_rows(const FramePart& part, RowRange rows) {
  if (!part.clear) return;
  const FrameView& frame = part.frame;
  for (int y = rows.begin; y < rows.end; ++y) {
    const std::ptrdiff_t first = y * frame.stride + part.x0;
    std::fill_n(frame.depth + first, frame.width - part.x0, contract::kDepthClear);
    std::fill_n(frame.payload + first, frame.width - part.x0, part.background);
  }
}

// So few that a band of 1920 px, of 480 KB, stays in L2 from its clear to its last triangle. A depth cell's
// height is a multiple of it, so a band lies in one row of depth cells (rule 6).
inline constexpr int kBandRowsLog2 = 5;
static_assert(contract::kDepthCell % (1 << kBandRowsLog2) == 0);

// Bins triangles to bands, and calls draw(band, rows) for each band of the part, in parallel. Band i's
// triangles are those of cell i in `bins`. Returns false if Bins::build() does; then nothing is drawn.
template <typename Draw>
bool draw_in_bands(TriangleSource& triangles, const FramePart& part, const Execution& execution, Bins& bins,
                   Draw&& draw) {
  constexpr int kWholeWidthLog2 = 14;
  static_assert(1 << kWholeWidthLog2 == contract::kMaxImageSide);
  const CellGrid grid{part.frame.width, part.frame.height, kWholeWidthLog2, kBandRowsLog2, part.x0, part.y0};
  if (!bins.build(triangles, grid, execution.threads, execution.target, Bins::Small::as_indices))
    return false;
  const int first = part.y0 >> kBandRowsLog2;
  parallel_for(execution.threads, grid.rows() - first, [&](int i) {
    const int band = first + i;
    draw(band, RowRange{std::max(band << kBandRowsLog2, part.y0),
                        std::min((band + 1) << kBandRowsLog2, part.frame.height)});
  });
  return true;
}

inline constexpr int kLongestVector = 16;  // px

// The task of drawing the triangles of a cell in the frame itself: those of a band, or of rows of a tile.
struct BandTask {
  const Bins& bins;
  int cell;
  // Ends at kLongestVector or further right. Its rows lie in one row of depth cells.
  //
  // A vector of pixels begins at a multiple of its length or ends with the area. So it may begin left of the
  // area, where it keeps what the frame holds. No other thread may draw there.
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
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) final {
    const FrameView& frame = part.frame;
    // Each vector of pixels lies in the frame, which must be as wide as the longest vector.
    const BandKernel kernel =
        kernel_for_(frame.width < kLongestVector ? SimdTarget::scalar : execution.target);
    const ClearKernel clear = clear_kernel(execution.target);
    return draw_in_bands(triangles, part, execution, bins_, [&](int band, RowRange rows) {
      // A span of tiles of one pixel, as wide as any image.
      constexpr TileSpan kWholeWidth{0, contract::kMaxImageSide};
      if (part.clear) clear({{&kWholeWidth, 1}, rows.begin, rows.end, 0, part, false});
      kernel({bins_, band, {part.x0, rows.begin, frame.width, rows.end}, frame});
    });
  }
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) final {
    StoredTriangles stored(triangles);
    draw_source(stored, part, execution);  // always true: stored triangles are not copied
  }

  BandKernel (*const kernel_for_)(SimdTarget);
  Bins bins_;
};

}  // namespace edgewise

#include <algorithm>

#include "core/parallel.h"
#include "core/triangle_source.h"
#include "edgewise/contract.h"
#include "raster/clear.h"
#include "raster/traversals.h"

namespace edgewise {

namespace {

// So few that a band of 1920 px, of 480 KB, stays in L2 from its clear to its last triangle. A depth cell's
// height is a multiple of it, so a band lies in one row of depth cells (rule 6).
constexpr int kBandRowsLog2 = 5, kBandRows = 1 << kBandRowsLog2;
static_assert(contract::kDepthCell % kBandRows == 0);
constexpr int kWholeWidthLog2 = 14;
static_assert(1 << kWholeWidthLog2 == contract::kMaxImageSide);

class Bands final : public Backend {
 public:
  explicit Bands(FrameKernel (*fill)(SimdTarget)) : fill_(fill) {}

 private:
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override {
    const FrameView& frame = part.frame;
    // One column, so a cell's index is its band's.
    const CellGrid grid{frame.width, frame.height, kWholeWidthLog2, kBandRowsLog2, part.x0, part.y0};
    if (!bins_.build(triangles, grid, execution.threads, execution.target, /*with_masks=*/false))
      return false;
    // Each vector of pixels lies left of the part's end (FrameTask::region).
    const FrameKernel fill = fill_(frame.width < kLongestVector ? SimdTarget::scalar : execution.target);
    const ClearKernel clear = clear_kernel(execution.target);
    const int first = part.y0 / kBandRows;
    parallel_for(execution.threads, grid.rows() - first, [&](int i) {
      const int band = first + i, y0 = std::max(band * kBandRows, part.y0),
                y1 = std::min((band + 1) * kBandRows, frame.height);
      const Interval columns{part.x0, frame.width};
      if (part.clear) clear({{&columns, 1}, y0, y1, part});
      fill({bins_, band, {part.x0, y0, frame.width, y1}, frame});
    });
    return true;
  }
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    StoredTriangles stored(triangles);
    draw_source(stored, part, execution);  // always true: stored triangles need no room
  }

  FrameKernel (*const fill_)(SimdTarget);
  Bins bins_;
};

}  // namespace

std::unique_ptr<Backend> band_backend(FrameKernel (*fill)(SimdTarget)) {
  return std::make_unique<Bands>(fill);
}

}  // namespace edgewise

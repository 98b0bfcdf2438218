// The backend `scanline`, the reference: walks a triangle's edges row by row and fills the spans between them
// (scanline_kernel.cpp). It shares binning and threads with `tiled`, so the two differ only in how they find
// and fill a triangle's pixels.
#include "edgewise/contract.h"
#include "raster/ablation.h"
#include "raster/tile_task.h"
#include "raster/tiles.h"

namespace edgewise {

namespace {

class Scanline final : public TileBackend {
  using TileBackend::TileBackend;
  bool draw_source(TriangleSource& triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) override {
    return draw_in_tiles(triangles, frame, background, execution, ablation_, contract::kMaxTile, scratch_,
                         Bins::Small::as_indices, scanline_kernel(execution.target));
  }
};

}  // namespace

extern const std::string_view summary_scanline;
const std::string_view summary_scanline =
    "walks the edges row by row and fills the spans between them; the reference";
std::unique_ptr<Backend> make_scanline(const Ablation& ablation) {
  return std::make_unique<Scanline>(ablation);
}
std::unique_ptr<Backend> make_scanline() {
  return make_scanline(Ablation{});
}

}  // namespace edgewise

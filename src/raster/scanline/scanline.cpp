// The reference: walk the triangle's boundaries row by row and fill the spans between them. What surrounds
// that is what `tiled` has (binning to tiles, tiles on threads), so the two differ in how they find and fill
// a triangle's pixels. Drawing lives in scanline_kernel.cpp.
#include "edgewise/contract.h"
#include "raster/ablation.h"
#include "raster/scanline/scanline_kernel.h"
#include "raster/tiles.h"

namespace edgewise {

namespace {

class Scanline final : public AblatableBackend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    draw_in_tiles(triangles, frame, background, execution, ablation, contract::kMaxTile, bins_,
                  Bins::Small::as_indices, scanline_kernel(execution.target));
  }
  Bins bins_;
};

}  // namespace

extern const std::string_view idea_scanline;
const std::string_view idea_scanline =
    "walks the edges row by row and fills the spans between them; the reference";
std::unique_ptr<Backend> make_scanline() {
  return std::make_unique<Scanline>();
}

}  // namespace edgewise

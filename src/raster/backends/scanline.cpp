// The reference: walk the triangle's boundaries row by row and fill the spans between them. What surrounds
// that is what `tiled` has (binning to tiles, tiles on threads), so the two differ in how they find and fill
// a triangle's pixels. Drawing lives in scanline_kernel.cpp.
#include <bit>

#include "raster/backend.h"
#include "raster/bins.h"
#include "raster/contract.h"
#include "raster/parallel.h"
#include "raster/scanline_kernel.h"

namespace edgewise {

namespace {

class Scanline final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    constexpr int kSizeLog2 = std::countr_zero(static_cast<unsigned>(contract::kMaxTile));
    const CellGrid grid{frame.width, frame.height, kSizeLog2, kSizeLog2};
    bins_.build(triangles, grid, execution.threads, execution.target);
    const TileKernel draw_tile = scanline_kernel(execution.target);
    const int columns = grid.columns();
    parallel_for(execution.threads, grid.cells(), [&](int cell) {
      draw_tile({triangles.data(), &bins_, cell, cell % columns << kSizeLog2, cell / columns << kSizeLog2,
                 kSizeLog2, frame, background});
    });
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

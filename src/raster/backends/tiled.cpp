// Every pixel independent, as on a GPU: triangles are binned to square tiles, and tiles are drawn in
// parallel, each in a buffer of its own, by SIMD edge functions. Binning lives in bins.cpp, drawing in
// tile_kernel.cpp.
#include <bit>

#include "raster/backend.h"
#include "raster/bins.h"
#include "raster/last_cache.h"
#include "raster/parallel.h"
#include "raster/tile_kernel.h"

namespace edgewise {

namespace {

WriteOut write_out_for(std::span<const ScreenTriangle> triangles, const FrameView& frame) {
  const auto pixels = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(frame.height);
  const std::size_t bytes = pixels * (sizeof(*frame.depth) + sizeof(*frame.payload)) + triangles.size_bytes();
  return bytes > last_cache_bytes() / 2 ? WriteOut::past_caches : WriteOut::through_caches;
}

class Tiled final : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    const int size_log2 = std::countr_zero(static_cast<unsigned>(execution.tile_size));
    const CellGrid grid{frame.width, frame.height, size_log2, size_log2};
    bins_.build(triangles, grid, execution.threads, execution.target, execution.ideas);
    TiledIdeas ideas = execution.ideas;
    if (ideas.write_out == WriteOut::by_size) ideas.write_out = write_out_for(triangles, frame);
    const TileKernel draw_tile = tile_kernel(execution.target);
    const int columns = grid.columns();
    parallel_for(execution.threads, grid.cells(), [&](int cell) {
      draw_tile({triangles.data(), &bins_, cell, cell % columns << size_log2, cell / columns << size_log2,
                 size_log2, frame, background, ideas});
    });
  }
  Bins bins_;
};

}  // namespace

extern const std::string_view idea_tiled;
const std::string_view idea_tiled =
    "SIMD edge functions over tiles, tiles on threads, every pixel independent";
std::unique_ptr<Backend> make_tiled() {
  return std::make_unique<Tiled>();
}

}  // namespace edgewise

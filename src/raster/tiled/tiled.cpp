// The backend `tiled`: bins triangles to square tiles (bins.cpp) and draws tiles in parallel, each in a
// buffer of its own, by SIMD edge functions (tile_kernel.cpp).
#include "raster/tile_options.h"
#include "raster/tile_task.h"
#include "raster/tiles.h"

namespace edgewise {

namespace {

class Tiled final : public TileBackend {
  using TileBackend::TileBackend;
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override {
    return draw_in_tiles(triangles, part, execution, options_, scratch_, tile_kernel(execution.target),
                         options_.light_tiles ? span_kernel(execution.target) : nullptr);
  }
};

}  // namespace

extern const std::string_view summary_tiled;
const std::string_view summary_tiled =
    "SIMD edge functions over tiles, tiles on threads, every pixel independent";
std::unique_ptr<Backend> make_tiled(const TileOptions& options) {
  return std::make_unique<Tiled>(options);
}
std::unique_ptr<Backend> make_tiled() {
  return make_tiled(TileOptions{});
}

}  // namespace edgewise

#include "lab/tiled_spans/tiled_spans.h"

#include "edgewise/contract.h"
#include "raster/tiles.h"

namespace edgewise::lab {

namespace {

class TiledSpans final : public TileBackend {
  using TileBackend::TileBackend;
  bool draw_source(TriangleSource& triangles, const FramePart& part, const Execution& execution) override {
    return draw_in_tiles(triangles, part, {execution.threads, contract::kMaxTile, execution.target}, options_,
                         scratch_, tiled_spans_kernel(execution.target));
  }
};

}  // namespace

std::unique_ptr<Backend> make_tiled_spans(const TileOptions& options) {
  return std::make_unique<TiledSpans>(options);
}

}  // namespace edgewise::lab

#include "lab/tiled_spans/tiled_spans.h"

#include "edgewise/contract.h"
#include "raster/tiles.h"

namespace edgewise::lab {

namespace {

class TiledSpans final : public TileBackend {
  using TileBackend::TileBackend;
  bool draw_source(TriangleSource& triangles, FrameView frame, std::uint32_t background,
                   const Execution& execution) override {
    return draw_in_tiles(triangles, frame, background, execution, ablation_, contract::kMaxTile, scratch_,
                         ablation_.coverage_masks ? Bins::Small::as_masks : Bins::Small::as_indices,
                         tiled_spans_kernel(execution.target));
  }
};

}  // namespace

std::unique_ptr<Backend> make_tiled_spans(const Ablation& ablation) {
  return std::make_unique<TiledSpans>(ablation);
}

}  // namespace edgewise::lab

#include "lab/cells/cells.h"

#include <vector>

#include "lab/cells/band_kernels.h"
#include "lab/tiled_spans/tiled_spans.h"
#include "raster/bands.h"
#include "raster/tile_options.h"

namespace edgewise::lab {

namespace {
constexpr TileOptions kTilesOnly{.coverage_masks = false, .hierarchical_depth = false, .light_tiles = false},
    kHiZ{.coverage_masks = false, .light_tiles = false};

template <BandKernel (*kKernel)(SimdTarget)>
std::unique_ptr<Backend> make_bands() {
  return std::make_unique<BandBackend>(kKernel);
}
}  // namespace

std::span<const Cell> cells() {
  static const std::vector<Cell> list = [] {
    struct Drawer {
      std::string_view name, traversal, fill, with;
      std::unique_ptr<Backend> (*make)();
    };
    constexpr Drawer kDrawers[] = {
        {"bands_spans", "bands", "spans", "", make_bands<band_spans_kernel>},
        {"bands_edges", "bands", "edges", "", make_bands<band_edges_kernel>},
        {"tiles_spans", "tiles", "spans", "", [] { return make_tiled_spans(kTilesOnly); }},
        {"tiles_edges", "tiles", "edges", "", [] { return make_tiled(kTilesOnly); }},
        {"tiles_spans_hiz", "tiles", "spans", "hiz", [] { return make_tiled_spans(kHiZ); }},
        {"tiles_edges_hiz", "tiles", "edges", "hiz", [] { return make_tiled(kHiZ); }},
        {"tiles_spans_hiz_masks", "tiles", "spans", "hiz+masks", [] { return make_tiled_spans({}); }},
        {"tiles_edges_hiz_masks", "tiles", "edges", "hiz+masks",
         [] { return make_tiled({.light_tiles = false}); }}};
    std::vector<Cell> all;
    for (const Drawer& d : kDrawers)
      for (const SimdTarget target : {SimdTarget::scalar, SimdTarget::best})
        if (d.with.empty() || target == SimdTarget::best)  // both need vectors
          all.push_back({{d.name, "a cell of the experiment", d.make}, d.traversal, d.fill, d.with, target});
    return all;
  }();
  return list;
}

std::string factors(const Cell& cell) {
  const auto factor = [](std::string_view key, std::string_view value) {
    return std::string(key) + ":" + std::string(value);
  };
  return factor("traversal", cell.traversal) + factor("/fill", cell.fill) +
         factor("/simd", name_of(resolve(cell.target))) +
         (cell.with.empty() ? "" : factor("/with", cell.with));
}

}  // namespace edgewise::lab

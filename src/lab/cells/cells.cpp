#include "lab/cells/cells.h"

#include <vector>

#include "lab/cells/band_edges.h"
#include "lab/tiled_spans/tiled_spans.h"
#include "raster/ablation.h"
#include "raster/bands.h"

namespace edgewise::lab {

namespace {
constexpr Ablation kTilesOnly{.coverage_masks = false, .hierarchical_depth = false},
    kHiZ{.coverage_masks = false};
}

std::span<const Cell> cells() {
  static const std::vector<Cell> list = [] {
    struct Drawer {
      std::string_view name, traversal, fill, with;
      std::unique_ptr<Backend> (*make)();
    };
    constexpr Drawer kDrawers[] = {
        {"bands_spans", "bands", "spans", "", [] { return make_scanline({.vector_test = false}); }},
        {"bands_edges", "bands", "edges", "",
         []() -> std::unique_ptr<Backend> {
           return std::make_unique<BandBackend>(band_edges_kernel, Ablation{});
         }},
        {"tiles_spans", "tiles", "spans", "", [] { return make_tiled_spans(kTilesOnly); }},
        {"tiles_edges", "tiles", "edges", "", [] { return make_tiled(kTilesOnly); }},
        {"tiles_spans_hiz", "tiles", "spans", "hiz", [] { return make_tiled_spans(kHiZ); }},
        {"tiles_edges_hiz", "tiles", "edges", "hiz", [] { return make_tiled(kHiZ); }},
        {"tiles_spans_hiz_masks", "tiles", "spans", "hiz+masks", [] { return make_tiled_spans({}); }},
        {"tiles_edges_hiz_masks", "tiles", "edges", "hiz+masks", [] { return make_tiled(Ablation{}); }}};
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

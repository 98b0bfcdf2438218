#include "raster/ablation.h"

namespace edgewise {

std::string describe(const Ablation& ablation) {
  std::string text;
  const auto add = [&](bool differs, const char* what) {
    if (differs) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(!ablation.vector_setup, "no vector set-up");
  add(!ablation.prefetch, "no prefetch");
  add(!ablation.coverage_masks, "no coverage masks");
  add(!ablation.hierarchical_depth, "no hierarchical depth");
  add(ablation.tile_store == TileStore::cached, "cached stores");
  add(ablation.tile_store == TileStore::streaming, "streaming stores");
  add(!ablation.empty_rows, "no rows of empty tiles");
  add(!ablation.several_tiles_per_task, "one tile per task");
  add(!ablation.vector_test, "no vector test");
  add(ablation.stepped, "stepped");
  return text;
}

std::unique_ptr<Backend> make(const BackendInfo& info, const Ablation& ablation) {
  if (info.name == "tiled") return make_tiled(ablation);
  if (info.name == "scanline") return make_scanline(ablation);
  if (info.name == "naive") return make_naive(ablation);
  return info.make();
}

}  // namespace edgewise

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
  add(ablation.stepped, "stepped");
  return text;
}

void draw(Backend& backend, std::span<const ScreenTriangle> triangles, FrameView frame,
          std::uint32_t background, const AblatedExecution& how) {
  auto* const switches = dynamic_cast<AblatableBackend*>(&backend);
  if (switches != nullptr) switches->ablation = how.ablation;
  backend.draw(triangles, frame, background, how.execution);
  if (switches != nullptr) switches->ablation = {};
}

}  // namespace edgewise

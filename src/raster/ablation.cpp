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
  struct Switched {  // for one frame, even if it throws
    Switched(AblatableBackend* b, const Ablation& ablation) : backend(b) {
      if (backend != nullptr) backend->ablation = ablation;
    }
    ~Switched() {
      if (backend != nullptr) backend->ablation = {};
    }
    AblatableBackend* backend;
  };
  const Switched switched(dynamic_cast<AblatableBackend*>(&backend), how.ablation);
  backend.draw(triangles, frame, background, how.execution);
}

}  // namespace edgewise

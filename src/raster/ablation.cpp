#include "raster/ablation.h"

namespace edgewise {

namespace {

// Switches a backend for one frame, even if drawing throws.
class Switched {
 public:
  Switched(Backend& backend, const Ablation& ablation) : backend_(dynamic_cast<AblatableBackend*>(&backend)) {
    if (backend_ != nullptr) backend_->ablation = ablation;
  }
  ~Switched() {
    if (backend_ != nullptr) backend_->ablation = {};
  }

 private:
  AblatableBackend* backend_;
};

}  // namespace

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
  add(ablation.stepped, "stepped");
  return text;
}

void draw(Backend& backend, std::span<const ScreenTriangle> triangles, FrameView frame,
          std::uint32_t background, const AblatedExecution& how) {
  const Switched switched(backend, how.ablation);
  backend.draw(triangles, frame, background, how.execution);
}

void draw(const Drawable& drawable, Frontend& frontend, const FrontendOptions& options, Backend& backend,
          FrameView frame, std::uint32_t background, const AblatedExecution& how) {
  const Switched switched(backend, how.ablation);
  draw(drawable, frontend, options, backend, frame, background, how.execution);
}

}  // namespace edgewise

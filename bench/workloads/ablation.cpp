#include "bench/workloads/ablation.h"

#include <algorithm>

namespace edgewise::bench {

std::vector<AblationStep> ablation_steps() {
  std::vector<AblationStep> steps{{"stepped", "naive", SimdTarget::best, {.stepped = true}}};
  Ablation ablation{false, false, false, false, TileStore::cached, false, false};
  for (const SimdTarget target : supported_targets())
    steps.push_back({target == SimdTarget::scalar ? "tiles" : std::string(name_of(target)), kAblationBackend,
                     target, ablation});
  const auto add = [&](const char* name, bool Ablation::*optimization) {
    ablation.*optimization = true;
    steps.push_back({name, kAblationBackend, SimdTarget::best, ablation});
  };
  add("vector-setup", &Ablation::vector_setup);
  add("prefetch", &Ablation::prefetch);
  add("coverage-masks", &Ablation::coverage_masks);
  add("hierarchical-depth", &Ablation::hierarchical_depth);
  ablation.tile_store = TileStore::automatic;
  steps.push_back({"tile-store", kAblationBackend, SimdTarget::best, ablation});
  steps.push_back({"two-calls", kAblationBackend, SimdTarget::best, {}, true, true, 1});
  steps.push_back({"one-tile-per-task",
                   kAblationBackend,
                   SimdTarget::best,
                   {.several_tiles_per_task = false},
                   true,
                   false,
                   2});
  return steps;
}

bool in_ablation(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"torus-knot", "terrain", "large", "medium", "small",
                                          "micro",      "sliver",  "grid4", "grid64"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

}  // namespace edgewise::bench

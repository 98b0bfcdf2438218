#include "bench/workloads/ablation.h"

#include <algorithm>

namespace edgewise::bench {

std::vector<AblationStep> ablation_steps() {
  Ablation ideas{false, false, false, false, WriteOut::through_caches};
  const auto with = [&](SimdTarget target) {
    Execution execution;
    execution.target = target;
    execution.ideas = ideas;
    return execution;
  };
  Execution stepped;
  stepped.stepped = true;
  std::vector<AblationStep> rungs{{"stepped", "naive", stepped}};
  for (const SimdTarget target : supported_targets())
    rungs.push_back({target == SimdTarget::scalar ? "tiles" : std::string(name_of(target)), kAblationBackend,
                     with(target)});
  const auto add = [&](const char* name, bool Ablation::*idea) {
    ideas.*idea = true;
    rungs.push_back({name, kAblationBackend, with(SimdTarget::best)});
  };
  add("vector-setup", &Ablation::vector_setup);
  add("prefetch", &Ablation::prefetch);
  add("patches", &Ablation::patches);
  add("hierarchical-depth", &Ablation::hierarchical_depth);
  return rungs;
}

bool in_ablation(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"torus-knot", "terrain", "large", "medium", "small",
                                          "micro",      "sliver",  "grid4", "grid64"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

}  // namespace edgewise::bench

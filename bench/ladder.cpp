#include "ladder.h"

#include <algorithm>

namespace edgewise::bench {

std::vector<Rung> ladder() {
  TiledIdeas ideas{false, false, false, false, WriteOut::through_caches};
  const auto with = [&](SimdTarget target) {
    Execution execution;
    execution.target = target;
    execution.ideas = ideas;
    return execution;
  };
  Execution stepped;
  stepped.stepped = true;
  std::vector<Rung> rungs{{"stepped", "naive", stepped}};
  for (const SimdTarget target : supported_targets())
    rungs.push_back({target == SimdTarget::scalar ? "tiles" : std::string(name_of(target)), kLadderBackend,
                     with(target)});
  const auto add = [&](const char* name, bool TiledIdeas::*idea) {
    ideas.*idea = true;
    rungs.push_back({name, kLadderBackend, with(SimdTarget::best)});
  };
  add("vector-setup", &TiledIdeas::vector_setup);
  add("prefetch", &TiledIdeas::prefetch);
  add("patches", &TiledIdeas::patches);
  add("hierarchical-depth", &TiledIdeas::hierarchical_depth);
  return rungs;
}

bool in_ladder(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"torus-knot", "terrain", "large", "medium", "small",
                                          "micro",      "sliver",  "grid4", "grid64"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

}  // namespace edgewise::bench

#include "bench/workloads/engine_runs.h"

#include <algorithm>

namespace edgewise::bench {

std::vector<EngineRun> engine_runs() {
  using lab::EngineNumbers;
  return {{"no-masks", std::nullopt, {.coverage_masks = false}},
          {"exact", EngineNumbers::exact},
          {"float_lt", EngineNumbers::float_lt},
          {"float_top_left", EngineNumbers::float_top_left},
          {"depth_float", EngineNumbers::depth_float},
          {"depth_24", EngineNumbers::depth_24},
          {"depth_16", EngineNumbers::depth_16}};
}

bool in_engine_runs(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"large", "medium", "small", "grid64"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

}  // namespace edgewise::bench

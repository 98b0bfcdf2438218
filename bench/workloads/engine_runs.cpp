#include "bench/workloads/engine_runs.h"

#include <algorithm>

namespace edgewise::bench {

std::vector<EngineRun> engine_runs() {
  using lab::EngineNumbers;
  return {{"exact", EngineNumbers::exact},
          {"int64", EngineNumbers::int64},
          {"double", EngineNumbers::float64},
          {"float", EngineNumbers::float32},
          {"float_rebased", EngineNumbers::float32_rebased},
          {"int32", EngineNumbers::int32}};
}

bool in_engine_runs(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"large", "medium", "small", "grid64"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

}  // namespace edgewise::bench

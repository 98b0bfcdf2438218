// What exactness costs in the backend `tiled`: its engine with other arithmetic in the edge functions.
#pragma once

#include <string_view>
#include <vector>

#include "lab/engine/engine.h"

namespace edgewise::bench {

struct EngineRun {
  std::string_view name;  // in row names, after "engine:"
  lab::EngineNumbers numbers;
};

// Each on one thread. The first is the backend without coverage masks, which only the exact numbers allow.
std::vector<EngineRun> engine_runs();

// Whether the engine runs on a scene: streams of few and of many triangles, with and without overdraw.
bool in_engine_runs(std::string_view scene);

}  // namespace edgewise::bench

// What exactness costs in the backend `tiled`: its engine with other numbers in the edge functions or depths.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lab/engine/engine_kernel.h"
#include "raster/ablation.h"

namespace edgewise::bench {

struct EngineRun {
  std::string_view name;                      // in row names, after "engine:"
  std::optional<lab::EngineNumbers> numbers;  // none: the backend itself
  Ablation ablation{};
};

// Each on one thread and without coverage masks, which only the exact numbers allow. The first is the backend
// with its masks switched off, the second must equal it.
std::vector<EngineRun> engine_runs();

// Whether the engine runs on a scene: streams of few and of many triangles, with and without overdraw.
bool in_engine_runs(std::string_view scene);

}  // namespace edgewise::bench

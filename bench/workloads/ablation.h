// The ablation: the optimizations of one backend, added one by one, so that a reader sees what each is worth.
// It begins at the naive backend and ends at the tiled backend's own rows, which the suite has already.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "raster/ablation.h"

namespace edgewise::bench {

inline constexpr std::string_view kAblationBackend = "tiled";

struct AblationStep {
  std::string name;  // in row names, after "step:"
  std::string_view backend;
  SimdTarget target;
  Ablation ablation;
};

// All on one thread, each with one optimization more than the step before. The first is the naive backend
// with stepped edges; the last lacks only the automatic tile store. The second step changes the backend, and
// with it tiles, blocks, lists and 32-bit lanes at once.
std::vector<AblationStep> ablation_steps();

// Whether the ablation runs on a scene: one of each kind does.
bool in_ablation(std::string_view scene);

}  // namespace edgewise::bench

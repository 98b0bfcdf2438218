// The ladder: one backend with its ideas added one by one, so that a reader sees what each is worth. It
// begins at the naive backend and ends at the last one's own rows, which the suite has already.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "edgewise/backend.h"

namespace edgewise::bench {

inline constexpr std::string_view kAblationBackend = "tiled";

struct AblationStep {
  std::string name;          // in row names, after "rung:"
  std::string_view backend;  // whose switches these are
  Execution execution;
};

// On one thread, each with one idea more than the one before: the first is naive with another inner loop, the
// last lacks the choice of how to write out. From the first to the second the backend changes, and with it
// more than one thing: tiles, blocks, lists and 32-bit lanes come together.
std::vector<AblationStep> ablation_steps();

// Whether the ladder is climbed in a scene: those of one kind each.
bool in_ablation(std::string_view scene);

}  // namespace edgewise::bench

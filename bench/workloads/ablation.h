// The ablation: the optimizations of one backend, added one by one, so that a reader sees what each is worth.
// The first part times the draw of prepared triangles on one thread. It begins at the naive backend and ends
// at the tiled backend's own row, which the suite has already. The second part times whole frames. It begins
// with the front end and the backend in two calls on one thread, and ends at the suite's row on two.
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
  bool whole_frame = false;
  bool two_calls = false;  // whole frames: without fusion and clusters
  int threads = 1;
};

// Each step has one optimization more than the one before. The first is the naive backend with stepped edges.
// The second changes the backend, and with it tiles, blocks, lists and 32-bit lanes at once. A whole frame in
// two calls lacks fusion if the scene is a stream, and clusters if it consists of meshes.
std::vector<AblationStep> ablation_steps();

// Whether the ablation runs on a scene: one of each kind does.
bool in_ablation(std::string_view scene);

}  // namespace edgewise::bench

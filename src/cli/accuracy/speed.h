// Times several ways to draw one scene, interleaved.
#pragma once

#include <functional>
#include <vector>

#include "cli/accuracy/accuracy.h"

namespace edgewise::tools {

struct TimedDraw {
  std::size_t method;  // index, for the caller
  int threads;
  SimdTarget target;
  std::function<void()> draw;
};

// Returns speeds in the order of `draws`. Repetitions are interleaved, so that load peaks of the machine hit
// all methods alike, and round i of two draws is a pair. Timed draws are warm: an untimed draw of the same
// method precedes each repetition, so that caches and branch predictor don't depend on the other methods. A
// draw straight after another method's is a few percent slower.
std::vector<Speed> time_interleaved(const std::vector<TimedDraw>& draws, bool quick);

}  // namespace edgewise::tools

// Times several ways to draw one scene beside one another.
#pragma once

#include <functional>
#include <vector>

#include "cli/accuracy/accuracy.h"

namespace edgewise::app {

struct TimedDraw {
  std::size_t method;  // index, for the caller
  int threads;
  std::function<void()> draw;
};

// In the order of `draws`. All take turns, so that a busy moment of the machine does not fall on one of them
// alone. What is timed is a warm draw: an untimed one comes before each block of timed ones, so that caches
// and branch predictor are as a draw of the same picture leaves them, whichever methods run beside it. A draw
// straight after another method's takes a few percent longer.
std::vector<Speed> time_in_turns(const std::vector<TimedDraw>& draws, bool quick);

}  // namespace edgewise::app

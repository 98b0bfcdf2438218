// Times several ways to draw one scene beside one another.
#pragma once

#include <functional>
#include <vector>

#include "app/accuracy.h"

namespace edgewise::app {

struct TimedDraw {
  std::size_t method;  // index, for the caller
  int threads;
  std::function<void()> draw;
};

// In the order of `draws`: each is run once to warm up, then all take turns, so that a busy moment of the
// machine does not fall on one of them alone.
std::vector<Speed> time_in_turns(const std::vector<TimedDraw>& draws, bool quick);

}  // namespace edgewise::app

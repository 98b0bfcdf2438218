// How long frames took, and what that says of smoothness.
#pragma once

#include <string>
#include <vector>

namespace edgewise::viewer {

struct FrameTimes {
  std::vector<double> milliseconds;  // from each frame's events to its pixels in the window
  double cpu_ms = 0;                 // of all threads, for all frames together
};

// "600 frames: median 3.10 ms, …".
std::string summary(FrameTimes times);

}  // namespace edgewise::viewer

// Frame times and their statistics.
#pragma once

#include <string>
#include <vector>

namespace edgewise::viewer {

struct FrameTimes {
  std::vector<double> milliseconds;  // from each frame's events to its pixels in the window
  double cpu_ms = 0;                 // CPU time of all threads, summed over all frames
};

// "600 frames: median 3.10 ms, …".
std::string summary(FrameTimes times);

}  // namespace edgewise::viewer

#include "viewer/frame_times.h"

#include <fmt/format.h>

#include <algorithm>

namespace edgewise::viewer {

std::string summary(FrameTimes times) {
  std::vector<double>& ms = times.milliseconds;
  if (ms.empty()) return "no frames";
  std::sort(ms.begin(), ms.end());
  const auto frames = static_cast<double>(ms.size());
  const auto percentile = [&](double p) { return ms[static_cast<std::size_t>(p * (frames - 1))]; };
  constexpr double kFrameAt60Hz_ms = 1000.0 / 60;
  const auto late = std::count_if(ms.begin(), ms.end(), [](double t) { return t > kFrameAt60Hz_ms; });
  return fmt::format(
      "{} frames: median {:.2f} ms, 95th percentile {:.2f}, 99th {:.2f}, worst {:.2f}; {} took longer than "
      "1/60 s; CPU {:.2f} ms per frame",
      ms.size(), percentile(0.5), percentile(0.95), percentile(0.99), ms.back(), late, times.cpu_ms / frames);
}

}  // namespace edgewise::viewer

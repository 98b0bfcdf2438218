#include "cli/accuracy/speed.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace edgewise::tools {

namespace {

// Mean time of `times` draws after one untimed draw.
double warm_ms(const TimedDraw& timed, int times) {
  timed.draw();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i) timed.draw();
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  return spent.count() / times;
}

}  // namespace

std::vector<Speed> time_interleaved(const std::vector<TimedDraw>& draws, bool quick) {
  const int repetitions = quick ? 5 : 21;
  const double least_ms = quick ? 2.0 : 5.0;  // per repetition; far above the clock's resolution
  std::vector<std::vector<double>> ms(draws.size());
  std::vector<int> times;
  for (const TimedDraw& timed : draws)
    times.push_back(
        std::clamp(static_cast<int>(std::ceil(least_ms / std::max(warm_ms(timed, 1), 1e-3))), 1, 1000));
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t i = 0; i < draws.size(); ++i) ms[i].push_back(warm_ms(draws[i], times[i]));

  std::vector<Speed> speeds;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    std::vector<double> sorted = ms[i];
    std::sort(sorted.begin(), sorted.end());
    speeds.push_back({draws[i].threads, draws[i].target, sorted[sorted.size() / 2], sorted.front(),
                      sorted.back(), std::move(ms[i])});
  }
  return speeds;
}

}  // namespace edgewise::tools

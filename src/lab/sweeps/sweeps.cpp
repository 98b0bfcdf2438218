// The registry of sweeps. A sweep is a function make_sweep_NAME() in one of this folder's files, and a line
// here.
#include "lab/sweeps/sweeps.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/nearest_name.h"
#include "core/parallel.h"

#define EDGEWISE_SWEEPS(X) \
  X(distance)              \
  X(aspect)                \
  X(legs)                  \
  X(height)                \
  X(pan)                   \
  X(translation)           \
  X(separation_at_10)      \
  X(separation_at_100)     \
  X(cycle)                 \
  X(sliver_depth)          \
  X(tilt_perspective)      \
  X(tilt_orthographic)     \
  X(edge_on)               \
  X(near_plane)            \
  X(vertex_w)              \
  X(origin)

namespace edgewise::lab {

#define EDGEWISE_DECLARE(name) Sweep make_sweep_##name();
EDGEWISE_SWEEPS(EDGEWISE_DECLARE)

Tally& Tally::operator+=(const Tally& other) {
  errors += other.errors;
  trials += other.trials;
  return *this;
}

std::span<const Sweep> sweeps() {
#define EDGEWISE_ENTRY(name) make_sweep_##name(),
  static const std::vector<Sweep> list{EDGEWISE_SWEEPS(EDGEWISE_ENTRY)};
  return list;
}

const Sweep& find_sweep(std::string_view name) {
  return find_named("sweep", name, sweeps(), &Sweep::name);
}

std::optional<double> SweepResult::starts_to_fail(std::size_t method) const {
  for (std::size_t position = 0; position < at.size(); ++position)
    if (fails(method, position)) return sweep->positions[position];
  return std::nullopt;
}

double SweepResult::y(const Tally& tally) const {
  if (tally.trials == 0) return 0.0;
  return sweep->y.scale * static_cast<double>(tally.errors) / static_cast<double>(tally.trials);
}

SweepResult run_sweep(const Sweep& sweep, bool quick, int threads, const std::function<void()>& on_position) {
  SweepResult result{&sweep, std::vector<Measured>(sweep.positions.size(), Measured(0))};
  std::mutex mutex;
  parallel_for(threads, static_cast<int>(sweep.positions.size()), [&](int i) {
    const auto position = static_cast<std::size_t>(i);
    result.at[position] = sweep.measure(sweep.positions[position], quick);
    const std::lock_guard lock(mutex);
    on_position();
  });
  return result;
}

std::vector<double> powers_of_two(int from, int to) {
  std::vector<double> positions;
  const int step = from < to ? 1 : -1;
  for (int exponent = from; exponent != to + step; exponent += step)
    positions.push_back(std::ldexp(1.0, exponent));
  return positions;
}

std::vector<double> decades(int from, int to) {
  // Quotients of exact numbers are correctly rounded, so that 0.002 equals the literal.
  const auto position = [](int digit, int exponent) {
    double power = 1.0;
    for (int i = 0; i < std::abs(exponent); ++i) power *= 10.0;
    return exponent < 0 ? digit / power : digit * power;
  };
  std::vector<double> positions;
  for (int exponent = std::min(from, to); exponent < std::max(from, to); ++exponent)
    for (const int digit : {1, 2, 5}) positions.push_back(position(digit, exponent));
  positions.push_back(position(1, std::max(from, to)));
  if (from > to) std::reverse(positions.begin(), positions.end());
  return positions;
}

}  // namespace edgewise::lab

// The list of sweeps, and what runs them.
#include "lab/sweeps/sweeps.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/nearest_name.h"
#include "core/parallel.h"

namespace edgewise::lab {

Tally& Tally::operator+=(const Tally& other) {
  errors += other.errors;
  trials += other.trials;
  return *this;
}

Measured& Measured::operator+=(const Measured& other) {
  for (std::size_t i = 0; i < methods.size(); ++i) methods[i] += other.methods[i];
  return *this;
}

std::uint64_t Measured::fewest_trials() const {
  return std::ranges::min(methods, {}, &Tally::trials).trials;
}

std::vector<MethodInfo> swept_methods(Family family) {
  if (family == Family::coverage) return swept_coverage_methods();
  if (family == Family::facing) return swept_facing_methods();
  if (family == Family::projection) return swept_projection_methods();
  return methods_of(family);
}

std::span<const Sweep> sweeps() {
  static const std::vector<Sweep> list = [] {
    std::vector<Sweep> all;
    for (const auto table :
         {coverage_sweeps, visibility_sweeps, facing_sweeps, clipping_sweeps, projection_sweeps})
      std::ranges::move(table(), std::back_inserter(all));
    return all;
  }();
  return list;
}

const Sweep& find_sweep(std::string_view name) {
  return find_named("sweep", name, sweeps(), &Sweep::name);
}

std::optional<double> SweepResult::starts_to_fail(std::size_t method) const {
  for (std::size_t position = 0; position < at.size(); ++position)
    if (at[position].methods[method].rate() > 1e-4) return sweep->positions[position];
  return std::nullopt;
}

Measured measure(const Sweep& sweep, double position, Effort effort) {
  Measured sum(swept_methods(sweep.family).size());
  for (std::uint64_t seed = 1; seed <= effort.scenes || sum.fewest_trials() < effort.trials; ++seed)
    sum += sweep.measure(position, seed);
  return sum;
}

SweepResult run_sweep(const Sweep& sweep, Effort effort, int threads) {
  SweepResult result{&sweep, std::vector<Measured>(sweep.positions.size(), Measured(0))};
  parallel_for(threads, static_cast<int>(sweep.positions.size()), [&](int i) {
    const auto position = static_cast<std::size_t>(i);
    result.at[position] = measure(sweep, sweep.positions[position], effort);
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

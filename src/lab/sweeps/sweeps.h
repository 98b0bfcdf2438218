// Stability sweeps: one parameter of a scene goes from easy to hard. At each position the errors of every
// method of a family are counted on random scenes, which shows where each method starts to fail.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

struct Tally {
  std::uint64_t errors = 0, trials = 0;

  double rate() const {
    return trials == 0 ? 0.0 : static_cast<double>(errors) / static_cast<double>(trials);
  }
  Tally& operator+=(const Tally& other);
  bool operator==(const Tally&) const = default;
};

// The counts at one position of a sweep.
struct Measured {
  explicit Measured(std::size_t method_count) : methods(method_count) {}
  Measured& operator+=(const Measured& other);
  std::uint64_t fewest_trials() const;

  std::vector<Tally> methods;  // in the order of swept_methods()
};

// tally(method) counts for each method.
template <typename Methods, typename TallyOf>
Measured measured(const Methods& methods, TallyOf&& tally) {
  Measured result(0);
  for (const auto& method : methods) result.methods.push_back(tally(method));
  return result;
}

struct XAxis {
  std::string_view name, unit;
};

// A point has at least so many trials, on at least so many scenes.
struct Effort {
  std::uint64_t trials, scenes;
};
inline constexpr Effort kFull{100'000, 4}, kQuick{5'000, 1};

struct Sweep {
  std::string_view name;
  Family family;
  std::string_view summary;  // one line
  XAxis x;
  std::vector<double> positions;  // positions on the x axis, from easy to hard
  // Scores all methods at one position on one scene, another one for each seed. Deterministic and
  // thread-safe. Has trials at every position.
  Measured (*measure)(double position, std::uint64_t seed);
  std::string_view why = "";  // ours fail, if they do
};

// The methods of the family; of ours in coverage and facing, one for each of 8, 12 and 15 subpixel bits.
std::vector<MethodInfo> swept_methods(Family family);
std::vector<MethodInfo> swept_coverage_methods();
std::vector<MethodInfo> swept_facing_methods();
std::vector<MethodInfo> swept_projection_methods();

// One table per family, in a file of its name.
std::vector<Sweep> coverage_sweeps();
std::vector<Sweep> visibility_sweeps();
std::vector<Sweep> facing_sweeps();
std::vector<Sweep> clipping_sweeps();
std::vector<Sweep> projection_sweeps();
std::span<const Sweep> sweeps();  // all of them
// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
const Sweep& find_sweep(std::string_view name);

struct SweepResult {
  const Sweep* sweep;
  std::vector<Measured> at;  // one per position

  // The first position where a method errs in more than 1 of 10^4 trials; nullopt if there is none.
  std::optional<double> starts_to_fail(std::size_t method) const;
};

SweepResult run_sweep(const Sweep& sweep, Effort effort, int threads);
// One position of it.
Measured measure(const Sweep& sweep, double position, Effort effort);

// Positions for the x axis: 2^from, 2^(from ± 1), … 2^to.
std::vector<double> powers_of_two(int from, int to);
// Positions 1, 2, 5 times powers of ten, from 10^from to 10^to, ascending or descending.
std::vector<double> decades(int from, int to);

}  // namespace edgewise::lab

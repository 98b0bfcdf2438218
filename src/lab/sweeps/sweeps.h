// Stability: one thing about a scene is turned from easy to hard, and every method of a family is counted at
// each place. Where does each start to fail?
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lab/family.h"

namespace edgewise::lab {

struct Tally {
  std::uint64_t errors = 0, trials = 0;

  Tally& operator+=(const Tally& other);
  bool operator==(const Tally&) const = default;
};

// One place of a sweep.
struct Measured {
  explicit Measured(std::size_t method_count) : methods(method_count) {}

  std::vector<Tally> methods;  // in the order of the family's registry
  // What the rounding of positions to 1/256 px costs by itself, where the truth knows the unrounded ones: a
  // method fails where it makes more errors than that.
  std::uint64_t by_snapping = 0;
};

struct XAxis {
  std::string_view name, unit;
  bool log;
};
struct YAxis {
  std::string_view name;
  bool log;
  double scale;  // y = scale * errors / trials
};

struct Sweep {
  std::string_view name;
  Family family;
  std::string_view idea;  // one line
  XAxis x;
  YAxis y;
  double cost;                 // seconds of one core, roughly: for estimates of the time left
  std::vector<double> places;  // on the x axis, from easy to hard
  // All methods at one place, from the same scenes; `quick`: fewer of them. Deterministic; called from
  // several threads at once.
  Measured (*measure)(double place, bool quick);
};

std::span<const Sweep> sweeps();
// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const Sweep& find_sweep(std::string_view name);

struct SweepResult {
  const Sweep* sweep;
  std::vector<Measured> at;  // one a place

  // The first place where a method makes more errors than snapping does by itself.
  std::optional<double> starts_to_fail(std::size_t method) const;
  bool fails(std::size_t method, std::size_t place) const {
    return at[place].methods[method].errors > at[place].by_snapping;
  }
  double y(const Tally& tally) const;
};

// `on_place` is called after each place, by one thread at a time.
SweepResult run_sweep(const Sweep& sweep, bool quick, int threads, const std::function<void()>& on_place);

// For the x axis: 2^from, 2^(from ± 1), … 2^to.
std::vector<double> powers_of_two(int from, int to);
// 10^from … 10^to, up or down, with the places 2 and 5 between.
std::vector<double> decades(int from, int to);

}  // namespace edgewise::lab

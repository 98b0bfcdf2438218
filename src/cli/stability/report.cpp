#include "cli/stability/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace edgewise::tools {

namespace {

using lab::Measured;
using lab::SweepResult;

std::string value_text(double x) {
  return x < 1.0 ? fmt::format("{:.4g}", x) : fmt::format("{:.7g}", x);
}

std::uint64_t fewest_trials(const SweepResult& result) {
  return std::ranges::min_element(result.at, {}, &Measured::fewest_trials)->fewest_trials();
}

// One method's curve in a sweep.
struct Curve {
  const SweepResult& result;
  std::size_t method;

  double y(std::size_t position) const { return result.y(result.at[position].methods[method]); }
  std::size_t worst() const {
    std::size_t worst = 0;
    for (std::size_t position = 1; position < result.at.size(); ++position)
      if (y(position) > y(worst)) worst = position;
    return worst;
  }
  std::size_t failing_positions() const {
    std::size_t count = 0;
    for (std::size_t position = 0; position < result.at.size(); ++position)
      count += result.fails(method, position);
    return count;
  }
  // 95 % upper bound of the rate, from the value with the fewest trials. Trials are not summed over values,
  // because all values may use the same scenes.
  double bound() const { return result.sweep->y.scale * lab::rate_bound(fewest_trials(result)); }
};

constexpr const char* kRow = "{:<20} {:>14} {:>11} {:>11} {:>11} {:>7}\n";

std::string row(std::string_view name, const Curve& curve) {
  const SweepResult& result = curve.result;
  const auto start = result.starts_to_fail(curve.method);
  std::string there;
  if (start) {
    const auto& positions = result.sweep->positions;
    there = fmt::format(
        "{:.4g}", curve.y(static_cast<std::size_t>(std::find(positions.begin(), positions.end(), *start) -
                                                   positions.begin())));
  }
  const std::size_t worst = curve.worst();
  const bool no_error = curve.y(worst) == 0.0;
  return fmt::format(
      kRow, name, start ? value_text(*start) : "never", there,
      no_error ? fmt::format("< {:.2g}", curve.bound()) : fmt::format("{:.4g}", curve.y(worst)),
      no_error ? "" : value_text(result.sweep->positions[worst]),
      fmt::format("{}/{}", curve.failing_positions(), result.at.size()));
}

}  // namespace

std::string stability_table(const SweepResult& result) {
  const lab::Sweep& sweep = *result.sweep;
  std::string text = fmt::format("{} ({}): {}\n", sweep.name, name_of(sweep.family), sweep.x.name);
  text += fmt::format("  {}\n  {} to {}{}{}; {}\n", sweep.summary, value_text(sweep.positions.front()),
                      value_text(sweep.positions.back()), sweep.x.unit.empty() ? "" : " ", sweep.x.unit,
                      sweep.y.name);
  text += fmt::format("  fails: more than {:.4g}; at least {} trials at each value\n", sweep.y.tolerance(),
                      fewest_trials(result));
  text += fmt::format(kRow, "method", "starts to fail", "error there", "max error", "at", "failing");
  const auto methods = lab::swept_methods(sweep.family);
  for (std::size_t i = 0; i < methods.size(); ++i) text += row(methods[i].name, {result, i});
  return text;
}

std::string list_of_sweeps() {
  std::string text;
  for (const lab::Sweep& sweep : lab::sweeps())
    text += fmt::format("{:<20} {:<10} {}\n", sweep.name, name_of(sweep.family), sweep.x.name);
  return text;
}

nlohmann::json sweep_json(const SweepResult& result) {
  const lab::Sweep& sweep = *result.sweep;
  nlohmann::json json{
      {"name", sweep.name},
      {"family", name_of(sweep.family)},
      {"summary", sweep.summary},
      {"x", {{"name", sweep.x.name}, {"unit", sweep.x.unit}, {"log", sweep.x.log}}},
      {"y", {{"name", sweep.y.name}, {"log", sweep.y.log}, {"tolerance", sweep.y.tolerance()}}},
      {"why", sweep.why},
      {"curves", nlohmann::json::array()}};
  const std::size_t positions = result.at.size();
  const auto methods = lab::swept_methods(sweep.family);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    nlohmann::json curve{{"method", methods[i].name}, {"source", methods[i].source}};
    for (std::size_t position = 0; position < positions; ++position) {
      curve["points"].push_back({sweep.positions[position], Curve{result, i}.y(position)});
      curve["trials"].push_back(result.at[position].methods[i].trials);
    }
    const auto start = result.starts_to_fail(i);
    curve["starts_to_fail"] = start ? nlohmann::json(*start) : nlohmann::json(nullptr);
    json["curves"].push_back(std::move(curve));
  }
  return json;
}

nlohmann::json stability_json(std::span<const SweepResult> results, bool quick) {
  nlohmann::json json{{"quick", quick}, {"sweeps", nlohmann::json::array()}};
  for (const SweepResult& result : results) json["sweeps"].push_back(sweep_json(result));
  return json;
}

}  // namespace edgewise::tools

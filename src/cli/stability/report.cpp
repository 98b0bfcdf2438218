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

double largest_rate(const SweepResult& result, std::size_t method) {
  double largest = 0.0;
  for (const Measured& measured : result.at) largest = std::max(largest, measured.methods[method].rate());
  return largest;
}

constexpr const char* kRow = "{:<20} {:>14} {:>14}\n";

}  // namespace

std::string stability_table(const SweepResult& result) {
  const lab::Sweep& sweep = *result.sweep;
  const std::uint64_t trials = fewest_trials(result);
  std::string text = fmt::format("{} ({}): {}\n", sweep.name, name_of(sweep.family), sweep.x.name);
  text += fmt::format("  {}\n  {} to {}{}{}; at least {} trials at each value\n", sweep.summary,
                      value_text(sweep.positions.front()), value_text(sweep.positions.back()),
                      sweep.x.unit.empty() ? "" : " ", sweep.x.unit, trials);
  text += fmt::format(kRow, "method", "starts to fail", "most per 10^6");
  const auto methods = lab::swept_methods(sweep.family);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto start = result.starts_to_fail(i);
    const double most = largest_rate(result, i);
    text += fmt::format(kRow, methods[i].name, start ? value_text(*start) : "never",
                        most == 0.0 ? fmt::format("< {:.2g}", 1e6 * lab::rate_bound(trials))
                                    : fmt::format("{:.4g}", 1e6 * most));
  }
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
  nlohmann::json json{{"name", sweep.name},
                      {"family", name_of(sweep.family)},
                      {"x", {{"name", sweep.x.name}, {"unit", sweep.x.unit}}},
                      {"why", sweep.why},
                      {"curves", nlohmann::json::array()}};
  const double scale = sweep.family == lab::Family::facing ? 100.0 : 1e6;
  const auto methods = lab::swept_methods(sweep.family);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    nlohmann::json& curve = json["curves"].emplace_back(
        nlohmann::json{{"method", methods[i].name}, {"source", methods[i].source}});
    for (std::size_t position = 0; position < result.at.size(); ++position) {
      const lab::Tally& tally = result.at[position].methods[i];
      curve["points"].push_back({sweep.positions[position], scale * static_cast<double>(tally.errors) /
                                                                static_cast<double>(tally.trials)});
      curve["trials"].push_back(tally.trials);
    }
    const auto start = result.starts_to_fail(i);
    curve["starts_to_fail"] = start ? nlohmann::json(*start) : nlohmann::json(nullptr);
  }
  return json;
}

nlohmann::json stability_json(std::span<const SweepResult> results) {
  nlohmann::json json{{"sweeps", nlohmann::json::array()}};
  for (const SweepResult& result : results) json["sweeps"].push_back(sweep_json(result));
  return json;
}

}  // namespace edgewise::tools

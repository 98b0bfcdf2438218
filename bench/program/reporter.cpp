#include "bench/program/reporter.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "support/json.h"

namespace edgewise::bench {

namespace {

void derive_rates(benchmark::BenchmarkReporter::Run& run) {
  const double s = run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
  if (s <= 0.0) return;
  auto& counters = run.counters;
  const auto triangles = counters.find("triangles");
  if (triangles == counters.end()) return;
  counters["Mtri/s"] = triangles->second.value / s * 1e-6;
  const auto covered = counters.find("covered_px");
  if (covered == counters.end() || covered->second.value == 0.0) return;
  const double covered_px = covered->second.value;
  counters["covered_Gpx/s"] = covered_px / s * 1e-9;
  counters["ns_per_covered_px"] = s * 1e9 / covered_px;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
}

// As Google Benchmark aggregates repetitions.
benchmark::BenchmarkReporter::Run median_of(const std::vector<benchmark::BenchmarkReporter::Run>& runs) {
  std::vector<double> real_s, cpu_s;
  for (const auto& run : runs) {
    real_s.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    cpu_s.push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
  }
  auto result = runs.front();
  result.run_type = benchmark::BenchmarkReporter::Run::RT_Aggregate;
  result.aggregate_name = "median";
  result.iterations = static_cast<benchmark::IterationCount>(runs.size());
  result.real_accumulated_time = median(real_s) * static_cast<double>(runs.size());
  result.cpu_accumulated_time = median(cpu_s) * static_cast<double>(runs.size());
  return result;
}

}  // namespace

Reporter::Reporter(std::vector<std::string> names_in_order)
    : names_(std::move(names_in_order)), console_(benchmark::CreateDefaultDisplayReporter()) {
  json_.SetOutputStream(&json_text_);
}

bool Reporter::ReportContext(const Context& context) {
  if (std::exchange(has_context_, true)) return true;
  Context plain = context;
  plain.name_field_width = 10;
  for (const auto& name : names_) plain.name_field_width = std::max(plain.name_field_width, name.size());
  const bool continues = console_->ReportContext(plain) && json_.ReportContext(plain);
  std::cerr << "Note: a warning that the library was built as DEBUG concerns Debian's libbenchmark, "
               "which only takes the time. The timed code is not affected.\n";
  return continues;
}

void Reporter::ReportRuns(const std::vector<Run>& runs) {
  for (Run run : runs) {
    run.run_name = {run.run_name.function_name, "", "", "", "", "", "", ""};
    auto& earlier = runs_[run.run_name.function_name];
    run.repetition_index = static_cast<std::int64_t>(earlier.size());
    earlier.push_back(std::move(run));
  }
}

void Reporter::finish() {
  std::vector<Run> shown;  // reported in one call: CSV's columns are the counters of the first call
  for (const auto& name : names_) {
    auto& runs = runs_[name];
    if (runs.empty()) continue;
    for (Run& run : runs) run.repetitions = static_cast<std::int64_t>(runs.size());
    shown.push_back(runs.size() == 1 ? runs.front() : median_of(runs));
    if (runs.size() > 1) runs.push_back(shown.back());
    if (!shown.back().error_occurred) derive_rates(shown.back());
    json_.ReportRuns(runs);
  }
  if (!shown.empty()) console_->ReportRuns(shown);
  console_->Finalize();
  json_.Finalize();
}

std::string Reporter::json() const {
  static const std::set<std::string_view> kOfEachRepetition{"name", "run_type", "iterations", "real_time",
                                                            "time_unit"};
  auto result = nlohmann::ordered_json::parse(json_text_.str());
  auto& context = result["context"];
  context.erase("host_name");
  context["executable"] = std::filesystem::path(context.value("executable", "")).filename().string();
  std::string text = "{\n\"context\": " + tools::json_text(context, 2) + ",\n\"benchmarks\": [";
  const char* separator = "\n";
  nlohmann::ordered_json first;
  for (auto& row : result["benchmarks"]) {
    for (const char* key : {"family_index", "per_family_instance_index", "run_name", "repetitions", "threads",
                            "cpu_time"})  // not ours
      row.erase(key);
    // A name's later repetitions hold only the counters that differ from the first's.
    if (first.is_null() || first["name"] != row["name"]) {
      first = row;
    } else {
      for (const auto& [key, value] : first.items())
        if (!kOfEachRepetition.contains(key) && row.contains(key) && row[key] == value) row.erase(key);
    }
    text += separator + tools::json_text(row);
    separator = ",\n";
  }
  return text + "\n]\n}\n";
}

}  // namespace edgewise::bench

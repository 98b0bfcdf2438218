#include "bench/reporter.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "support/json_text.h"

namespace edgewise::bench {

namespace {

bool is_median(const benchmark::BenchmarkReporter::Run& run) {
  return run.aggregate_name == "median";
}

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

}  // namespace

Reporter::Reporter(std::vector<std::string> names_in_order)
    : names_(std::move(names_in_order)), console_(benchmark::CreateDefaultDisplayReporter()) {
  json_.SetOutputStream(&json_text_);
}

bool Reporter::ReportContext(const Context& context) {
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
    // Charts and tables show the median. The file's repetitions give mean and deviation.
    if (run.run_type == Run::RT_Aggregate && !is_median(run)) continue;
    run.run_name = {run.run_name.function_name, "", "", "", "", "", "", ""};
    if (!run.error_occurred) derive_rates(run);
    runs_[run.run_name.function_name].push_back(std::move(run));
  }
}

void Reporter::Finalize() {
  std::vector<Run> shown;  // reported in one call: CSV's columns are the counters of the first call
  for (const auto& name : names_) {
    const auto& runs = runs_[name];
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(shown), is_median);
    if (std::none_of(runs.begin(), runs.end(), is_median) && !runs.empty()) shown.push_back(runs.front());
    if (!runs.empty()) json_.ReportRuns(runs);
  }
  if (!shown.empty()) console_->ReportRuns(shown);
  console_->Finalize();
  json_.Finalize();
}

std::map<std::string, double> Reporter::median_ms() const {
  std::map<std::string, double> medians;
  for (const auto& [name, runs] : runs_) {
    std::vector<double> times_ms;
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        times_ms.push_back(run.GetAdjustedRealTime() * 1e3 / benchmark::GetTimeUnitMultiplier(run.time_unit));
    if (times_ms.empty()) continue;
    std::sort(times_ms.begin(), times_ms.end());
    medians[name] = (times_ms[(times_ms.size() - 1) / 2] + times_ms[times_ms.size() / 2]) / 2.0;
  }
  return medians;
}

std::string Reporter::json() const {
  auto result = nlohmann::ordered_json::parse(json_text_.str());
  auto& context = result["context"];
  context.erase("host_name");
  context["executable"] = std::filesystem::path(context.value("executable", "")).filename().string();
  std::string text = "{\n\"context\": " + tools::json_text(context, 2) + ",\n\"benchmarks\": [";
  const char* separator = "\n";
  for (const auto& row : result["benchmarks"]) {
    text += separator + tools::json_text(row);
    separator = ",\n";
  }
  return text + "\n]\n}\n";
}

}  // namespace edgewise::bench

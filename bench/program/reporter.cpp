#include "bench/program/reporter.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "support/json.h"

namespace edgewise::bench {

namespace {

// The repetition of median time, of an even number the slower of the two in the middle.
benchmark::BenchmarkReporter::Run median_of(std::vector<benchmark::BenchmarkReporter::Run> runs) {
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::ranges::nth_element(runs, middle, {}, [](const auto& run) { return run.GetAdjustedRealTime(); });
  middle->run_type = benchmark::BenchmarkReporter::Run::RT_Aggregate;
  middle->aggregate_name = "median";
  return *middle;
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
    json_.ReportRuns(runs);
  }
  if (!shown.empty()) console_->ReportRuns(shown);
  console_->Finalize();
  json_.Finalize();
}

std::string Reporter::json() const {
  auto result = nlohmann::ordered_json::parse(json_text_.str());
  auto& context = result["context"];
  context.erase("host_name");
  context["executable"] = std::filesystem::path(context.value("executable", "")).filename().string();
  return tools::json_text(result, 1) + '\n';
}

}  // namespace edgewise::bench

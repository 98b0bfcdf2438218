#include "bench/program/reporter.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "support/json.h"

namespace edgewise::bench {

namespace {

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

// Google Benchmark's own console and JSON output of several runs, each of which is one repetition: with plain
// row names in the suite's order, medians, and without the host name.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace edgewise::bench {

class Reporter final : public benchmark::BenchmarkReporter {
 public:
  explicit Reporter(std::vector<std::string> names_in_order);

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  // After the last run: prints.
  void finish();

  // After finish().
  std::string json() const;

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<Run>> runs_;
  bool has_context_ = false;
  benchmark::BenchmarkReporter* console_;
  benchmark::JSONReporter json_;
  std::ostringstream json_text_;
};

}  // namespace edgewise::bench

// Google Benchmark's own console and JSON output, tidied: rows bear their plain names and stand in the
// suite's order however the repetitions were interleaved, rates are derived from the time, and no host name
// is kept.
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
  void Finalize() override;

  // After Finalize(): of the rows that were timed, by name.
  std::map<std::string, double> median_ms() const;
  // After Finalize(): the JSON, one line a row.
  std::string json() const;

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<Run>> runs_;
  benchmark::BenchmarkReporter* console_;
  benchmark::JSONReporter json_;
  std::ostringstream json_text_;
};

}  // namespace edgewise::bench

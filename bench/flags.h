// The benchmark's command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/suite.h"

namespace edgewise::bench {

struct Flags {
  SuiteOptions suite;
  std::string out;                     // --benchmark_out
  std::string model_out;               // --model_out
  std::vector<std::string> benchmark;  // the remaining options, for Google Benchmark
  std::vector<std::string> known;      // the names of all options, Google Benchmark's included
  // Whether our numbers of repetitions and iterations hold, not the user's.
  bool own_repetitions = true, own_iterations = true;
  bool need_peers = false;
  bool readable = true;  // standard output is a table for people, not JSON or CSV
};

// None after --help. Throws CLI11's exceptions, and std::invalid_argument for --peers if no peer was built.
std::optional<Flags> parse_flags(int argc, char** argv);

}  // namespace edgewise::bench

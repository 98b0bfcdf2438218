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
  std::vector<std::string> benchmark;  // what is left for Google Benchmark
  std::vector<std::string> known;      // the names of all options, Google Benchmark's included
  bool own_repetitions = true, own_iterations = true;
  bool need_peers = false;
  bool readable = true;  // standard output is for people, not JSON or CSV
};

// None if only help was asked for. Throws what CLI11 throws, and std::invalid_argument for --peers where none
// was built.
std::optional<Flags> parse_flags(int argc, char** argv);

}  // namespace edgewise::bench

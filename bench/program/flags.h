// The benchmark's command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/suite.h"

namespace edgewise::bench {

struct Flags {
  SuiteOptions suite;
  bool need_peers = false;             // fail if none starts
  std::string out;                     // --benchmark_out
  std::vector<std::string> benchmark;  // the remaining options, for Google Benchmark
  std::vector<std::string> known;      // the names of all options, Google Benchmark's included
  std::optional<int> repetitions;      // of each row, if the user asked
  bool own_iterations = true;          // our numbers of iterations hold, not the user's
};

// None after --help. Throws CLI11's exceptions.
std::optional<Flags> parse_flags(int argc, char** argv);

}  // namespace edgewise::bench

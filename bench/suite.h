// The list of benchmark rows: scenes × backends × threads, the sweeps, and the laboratory's methods. Nothing
// is loaded or drawn here.
#pragma once

#include <string>
#include <vector>

#include "bench/row.h"

namespace edgewise::bench {

struct SuiteOptions {
  bool quick = false;
  int width = 1920, height = 1080;       // px
  bool size_asked = false;               // otherwise a .tri file is drawn at its own size
  std::vector<std::string> scenes;       // names or files; empty: the whole suite
  std::vector<std::string> more_scenes;  // beside the whole suite
  bool fit = false;                      // for meshes in `scenes` and `more_scenes`
  bool methods = false;                  // of the laboratory, on `scenes`; the whole suite has them anyway
  bool peers = true;                     // those in the suite, if built
  bool all_peers = false;                // beside the methods, too
};

// Throws as load_source does for an invalid name or file, and std::invalid_argument for two sources whose
// rows would have the same names.
std::vector<Row> make_suite(const SuiteOptions& options);

}  // namespace edgewise::bench

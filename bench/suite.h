// The list of benchmark rows: scenes × backends × threads, the sweeps, and the laboratory's methods. Nothing
// is loaded or drawn here.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/row.h"

namespace edgewise::bench {

// 1, 2, their doubles below the number of usable cores, and that number.
std::set<int> default_thread_counts();

struct SuiteOptions {
  bool quick = false;                               // fewer scenes and rows
  double scale = 1.0;                               // of the scenes that can be scaled
  int width = 1920, height = 1080;                  // px
  int subpixel_bits = 8;                            // of scenes' frames
  bool size_asked = false;                          // otherwise a .tri file is drawn at its own size
  std::vector<std::string> scenes;                  // names or files; empty: the whole suite
  std::vector<std::string> more_scenes;             // beside the whole suite
  std::set<int> threads = default_thread_counts();  // of whole frames and their parts
  bool fit = false;                                 // for meshes in `scenes` and `more_scenes`
  std::string needs;     // a file whose pipelines are timed beside the exact one; empty: none
  bool methods = false;  // of the laboratory, on `scenes`; the whole suite has them anyway
  bool peers = true;     // those in the suite, if built
};

// A scene's name in row names, where ':' and '/' are separators: see tools::source_name().
std::string name_in_rows(const std::string& name_or_path);

// A cell of the experiment: a composition on one kind of SIMD target.
struct Cell {
  const BackendInfo* backend;
  SimdTarget target;    // scalar or best
  std::string factors;  // "traversal:tiles/fill:spans/simd:avx512/with:hiz"
};
// The twelve cells.
std::vector<Cell> cells();

// Throws as load_source does for an invalid name or file, and std::invalid_argument for two sources whose
// rows would have the same names.
std::vector<Row> make_suite(const SuiteOptions& options);

}  // namespace edgewise::bench

// The workloads of the growth charts: one quantity grows by a constant factor from row to row, the others
// stay the same.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bench/workloads/workload.h"

namespace edgewise::bench {

struct GrowthStep {
  std::string what;  // in row names: "count:1000", "SCENE/size:512x512", "overdraw:4"
  std::shared_ptr<Workload> workload;
};

// Three sweeps: the number of triangles of one size in one image; the pixels of an image of one scene; and
// the overdraw by large triangles. Image sizes are left out if two frames (the row's and its reference) would
// fill more than half of the machine's memory.
std::vector<GrowthStep> growth_steps(int width, int height);

// `count` triangles of `area_px` at random positions and depths.
tools::Source random_source(int width, int height, std::size_t count, double area_px);

}  // namespace edgewise::bench

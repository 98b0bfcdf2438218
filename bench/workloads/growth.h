// What the growth charts are made of: one quantity grows, from row to row by a constant factor, and nothing
// else does.
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

// Triangles, of one size, in one image; pixels, under one scene; and how often large triangles cover each
// pixel. `quick` leaves out the costly ends. So does a machine that two of the largest frames, the row's and
// its reference, would fill more than half.
std::vector<GrowthStep> growth_steps(int width, int height, bool quick);

// Triangles of one area at random places and depths.
app::Source random_source(int width, int height, std::size_t count, double area_px);

}  // namespace edgewise::bench

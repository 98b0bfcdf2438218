// What the sweeps of coverage share.
#pragma once

#include <vector>

#include "lab/coverage/score.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

inline constexpr YAxis kErrorsPerCrossing{"wrong pixels per 10^6 edge crossings", true, 1e6};

// Adds what each method gets wrong in a picture, against the truth of the positions as they are.
void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window);

// The nearest multiple of 1 / places px. Pictures on the grid of 1/256 px have one truth, snapped or not:
// what is wrong then is arithmetic, or snapping coarser than ours.
float on_grid(double px, int places = 256);

// A jittered grid of cells whose vertices are rounded to a grid, or not for 0, and then moved to `x`, `y`.
std::vector<FloatTriangle> moved_mesh(int side_px, double cell_px, std::uint64_t seed, int places, double x,
                                      double y);

}  // namespace edgewise::lab

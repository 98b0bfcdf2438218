// Shared by the coverage sweeps.
#pragma once

#include <vector>

#include "lab/coverage/score.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

inline constexpr YAxis kErrorsPerCrossing{"wrong pixels per 10^6 edge crossings", true, 1e6};

// Adds each method's errors in a picture, against the float truth.
void add_picture(Measured& sums, const std::vector<FloatTriangle>& triangles, Window window);

// The nearest multiple of 1 / steps_per_px px. For vertices on the grid of 1/256 px both truths agree, so
// that all errors come from arithmetic or from snapping that is coarser than ours.
float on_grid(double px, int steps_per_px = 256);

// A jittered grid of cells. Rounds the vertices to multiples of 1 / steps_per_px px, or not if `steps_per_px`
// is 0, and then moves them by (x, y) px.
std::vector<FloatTriangle> moved_mesh(int side_px, double cell_px, std::uint64_t seed, int steps_per_px,
                                      double x, double y);

}  // namespace edgewise::lab

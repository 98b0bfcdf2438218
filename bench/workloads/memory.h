// The peak memory of the first frame of newly made objects.
#pragma once

#include "bench/row.h"

namespace edgewise::bench {

// A new front end, frame and backend draw the row's frame once. Returns by how much the process's resident
// memory grew; none if /proc lacks the figures. Pages that are allocated but not written do not count.
// Requires prepare(true) on the workload.
std::optional<double> peak_bytes_of_first_frame(const Row& row);

}  // namespace edgewise::bench

// The peak memory of a frame, measured on the first frame of newly made objects.
#pragma once

#include <optional>

#include "bench/row.h"

namespace edgewise::bench {

// The peak growth in bytes of the process's resident memory while a new front end, frame and backend draw the
// row's frame once. Pages that are allocated but not written do not count. None if Linux's /proc does not
// have the figures. Requires prepare(true) on the workload.
std::optional<double> peak_bytes(const Row& row);

}  // namespace edgewise::bench

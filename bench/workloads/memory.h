// The first frame of newly made objects: its peak memory and its duration.
#pragma once

#include "bench/row.h"

namespace edgewise::bench {

// A new front end, frame and backend draw the row's frame once. Pages that are allocated but not written do
// not count as memory. Requires prepare(true) on the workload.
FirstFrame draw_first_frame(const Row& row);

}  // namespace edgewise::bench

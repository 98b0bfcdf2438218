// The JSON file of model estimates, which is separate from the timings.
#pragma once

#include <span>
#include <string>

#include "bench/row.h"

namespace edgewise::bench {

// "scheduled" holds the estimates for more cores (see scaling.h), "costs" the cost model's parts for timed
// rows (see cost_model.h), "second_thread" the waits of two threads (see second_thread.h). `barrier_s` is
// FrameWork::time_s's.
std::string model_json(std::span<const Row> rows, double barrier_s);

}  // namespace edgewise::bench

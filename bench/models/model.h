// Estimates from models, which are kept apart from what is timed.
#pragma once

#include <span>
#include <string>

#include "bench/suite.h"

namespace edgewise::bench {

// As JSON: "scheduled" has the rows of more cores than there are (see scaling.h), "costs" the cost model's
// parts under a timed row (see limit.h). `barrier_s` as in FrameWork::time_s.
std::string model_json(std::span<const Row> rows, double barrier_s);

}  // namespace edgewise::bench

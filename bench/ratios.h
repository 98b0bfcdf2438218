// The speed of our backend relative to each peer.
#pragma once

#include <map>
#include <string>

#include "bench/row.h"

namespace edgewise::bench {

// One line per peer row with a timed row of kAblationBackend of the same work and thread count; empty if
// there is none. `median_ms` is by row name.
std::string ratio_table(const std::vector<Row>& rows, const std::map<std::string, double>& median_ms);

}  // namespace edgewise::bench

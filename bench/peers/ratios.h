// How many times faster our backend is than each peer.
#pragma once

#include <map>
#include <string>

#include "bench/suite.h"

namespace edgewise::bench {

// A line for each row of a peer that was timed beside one of ours with as many threads; empty if there is
// none. `median_ms` is by row name.
std::string ratio_table(const std::vector<Row>& rows, const std::map<std::string, double>& median_ms);

}  // namespace edgewise::bench

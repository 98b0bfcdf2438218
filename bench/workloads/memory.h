// How much memory a frame needs at its worst: the first one, by fresh objects.
#pragma once

#include <optional>

#include "bench/suite.h"

namespace edgewise::bench {

// Bytes by which the process grows, at the most, while a fresh front end, frame and backend draw the row's
// frame once; what is not touched does not count. None where Linux's /proc does not tell. Needs the workload
// prepared with its scene.
std::optional<double> peak_bytes(const Row& row);

}  // namespace edgewise::bench

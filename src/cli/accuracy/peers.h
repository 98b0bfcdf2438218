// The rasterizers of other projects (bench/peers) as coverage methods.
#pragma once

#include <span>

#include "lab/coverage/coverage.h"

namespace edgewise::tools {

// Those that start here; the first call names the others on stderr. Throws std::invalid_argument if this
// build has no peers, and std::runtime_error if none starts.
std::span<const lab::CoverageMethod> peer_methods();

}  // namespace edgewise::tools

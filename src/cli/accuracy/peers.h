// The rasterizers of other projects (bench/peers) as coverage methods.
#pragma once

#include <span>

#include "lab/coverage/coverage.h"

namespace edgewise::tools {

// Throws std::invalid_argument if this build has no peers, and std::runtime_error if one cannot start.
std::span<const lab::CoverageMethod> peer_methods();

}  // namespace edgewise::tools

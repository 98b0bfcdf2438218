// A soak's record for people.
#pragma once

#include <string>

#include "cli/soak/record.h"

namespace edgewise::soak {

// What was covered, in a table of the families and one of backends and SIMD targets; what differs and how to
// see it again; how it ended, with the statistical bound.
std::string report(const Record& record);

}  // namespace edgewise::soak

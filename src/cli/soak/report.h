// The record of a soak test as text.
#pragma once

#include <string>

#include "cli/soak/record.h"

namespace edgewise::soak {

// Tables of comparisons per family, per backend and SIMD target, and per front-end SIMD target; the findings
// with the commands that reproduce them; totals, and the 95 % upper bounds if nothing differs.
std::string report(const Record& record);

}  // namespace edgewise::soak

#pragma once

#include "edgewise/execution.h"

namespace edgewise {

// `execution` with a resolved target. Throws std::invalid_argument.
Execution checked(const Execution& execution);

}  // namespace edgewise

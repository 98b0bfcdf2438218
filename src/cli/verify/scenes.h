// The scenes that verify looks at: scaled down so that much can be compared in little time.
#pragma once

#include <cstdint>

#include "cli/verify/verify.h"

namespace edgewise::app {

// The scene at the plan's size.
Shot shot_for_comparison(const VerifyPlan& plan, const std::string& name);

// The scene so small that the oracle can draw it: pixels times triangles stay within its budget.
Shot shot_for_oracle(const VerifyPlan& plan, const std::string& name);

// Watertight over the whole image, so that each pixel has exactly one triangle.
bool covers_each_pixel_once(const Source& source);

}  // namespace edgewise::app

// The scenes of `edgewise verify`, scaled down so that many configurations can be compared in little time.
#pragma once

#include <cstdint>

#include "cli/verify/verify.h"

namespace edgewise::tools {

// The scene at the plan's size.
Shot shot_for_comparison(const VerifyPlan& plan, const std::string& name);

// The scene scaled down for the oracle: pixels times triangles stay within its budget.
Shot shot_for_oracle(const VerifyPlan& plan, const std::string& name);

// Whether the scene is watertight over the whole image, so that each pixel is covered exactly once.
bool covers_each_pixel_once(const Source& source);

}  // namespace edgewise::tools

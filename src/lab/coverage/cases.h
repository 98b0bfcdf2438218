// Small scenes on which coverage methods fail, as unsnapped screen triangles.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

struct CoverageCase {
  std::string_view name;
  std::string_view summary;  // one line
  Size size;
  std::vector<FloatTriangle> (*make)();
};

std::span<const CoverageCase> coverage_cases();
// Throws std::invalid_argument for an unknown name; the message suggests the nearest known one.
const CoverageCase& find_coverage_case(std::string_view name);

// Converts a stream's triangles without a front end: nothing is clipped, culled or snapped.
std::vector<FloatTriangle> float_triangles(const TriangleStream& stream);

}  // namespace edgewise::lab

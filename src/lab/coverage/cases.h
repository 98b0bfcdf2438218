// The smallest scenes that show where coverage fails, as screen triangles.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lab/method.h"

namespace edgewise::lab {

struct CoverageCase {
  std::string_view name;
  std::string_view idea;  // one line
  Size size;
  std::vector<FloatTriangle> (*make)();
};

std::span<const CoverageCase> coverage_cases();
// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const CoverageCase& find_coverage_case(std::string_view name);

// A triangle-stream's triangles as they are, without a front end.
std::vector<FloatTriangle> float_triangles(const TriangleStream& stream);

}  // namespace edgewise::lab

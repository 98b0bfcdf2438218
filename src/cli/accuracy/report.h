// Prints an accuracy report as text (tables per family) and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/accuracy/accuracy.h"

namespace edgewise::tools {

// At most 80 columns. A table sums all scenes of a family, small test scenes apart. Where no error was
// observed, it prints the 95 % upper bound of the rate.
std::string accuracy_tables(const AccuracyReport& report);

nlohmann::json accuracy_json(const AccuracyReport& report, const AccuracyPlan& plan);

}  // namespace edgewise::tools

// An accuracy report for people (a table a family) and for machines (JSON).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/accuracy/accuracy.h"

namespace edgewise::app {

// At most 80 columns. All scenes of a family taken together; where no error was seen, the bound that this
// sets on the rate.
std::string accuracy_tables(const AccuracyReport& report);

nlohmann::json accuracy_json(const AccuracyReport& report, const AccuracyPlan& plan);

}  // namespace edgewise::app

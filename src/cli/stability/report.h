// Sweep results as tables and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "lab/sweeps/sweeps.h"

namespace edgewise::tools {

// At most 80 columns.
std::string stability_table(const lab::SweepResult& result);
std::string list_of_sweeps();

nlohmann::json sweep_json(const lab::SweepResult& result);
nlohmann::json stability_json(std::span<const lab::SweepResult> results);

}  // namespace edgewise::tools

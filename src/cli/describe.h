// What the front end did, for people and for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "edgewise/frontend.h"

namespace edgewise::app {

nlohmann::json stats_json(const FrontendStats& stats);

// "12 triangles, 6 drawn; 6 culled": what is zero is left out.
std::string stats_text(const FrontendStats& stats);

}  // namespace edgewise::app

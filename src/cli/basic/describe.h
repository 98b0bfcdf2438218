// The front end's statistics as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "edgewise/frontend.h"

namespace edgewise::tools {

nlohmann::json stats_json(const FrontendStats& stats);

// "12 triangles, 6 drawn; 6 culled by facing": zero counts are omitted.
std::string stats_text(const FrontendStats& stats);

// Why a picture of these triangles is empty: "12 triangles outside the view, 3 culled by facing".
std::string why_empty(const FrontendStats& stats);

}  // namespace edgewise::tools

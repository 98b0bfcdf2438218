// What a person needs to see a finding again: a small .tri, and commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/soak/check.h"

namespace edgewise::soak {

// Writes FOLDER/seed-S-case-N-BACKEND-vs-JUDGE.tri with as few of the frame's triangles as still differ
// (nothing for an empty folder name), and tells all about the finding, "replay" among it: the commands that
// show it. Files that cannot be written don't lose the finding: "trouble" says why.
nlohmann::json evidence_of(const std::filesystem::path& folder, std::uint64_t seed, const Case& c,
                           const Finding& finding, Checker& checker);

}  // namespace edgewise::soak

// What a person needs to see a finding again: a small .tri, and commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/soak/check.h"

namespace edgewise::soak {

struct Evidence {
  std::string program;           // what the commands call; a path or a name
  std::filesystem::path folder;  // for .tri files, made when needed; empty: none are written
  std::function<bool()> stop;    // then the file holds what is left by now
};

// Writes FOLDER/seed-S-case-N-BACKEND-vs-JUDGE.tri with as few of the frame's triangles as still differ, and
// tells all about the finding, "replay" among it: the commands that show it, for a shell in any folder. Files
// that cannot be written don't lose the finding: "trouble" says why.
nlohmann::json evidence_of(const Evidence& evidence, std::uint64_t seed, const Case& c,
                           const Finding& finding, Checker& checker);

}  // namespace edgewise::soak

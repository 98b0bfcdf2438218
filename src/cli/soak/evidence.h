// Evidence to reproduce a finding: a reduced .tri file and shell commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/soak/check.h"

namespace edgewise::soak {

struct Evidence {
  std::string program;           // path or name of the program in the commands
  std::filesystem::path folder;  // for .tri files, created when needed; empty: write none
  std::function<bool()> stop;    // true ends the reduction; the file then holds the triangles left
};

// Writes FOLDER/seed-S-case-N-BACKEND-vs-JUDGE.tri with as few of the frame's triangles as still differ.
// Returns the finding as JSON; "replay" holds the commands that reproduce it, for a shell in any folder. If
// the file cannot be written, the finding is kept and "trouble" holds the reason.
nlohmann::json evidence_of(const Evidence& evidence, std::uint64_t seed, const Case& c,
                           const Finding& finding, Checker& checker);

}  // namespace edgewise::soak

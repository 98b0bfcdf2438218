// `edgewise verify --random`: draws random and adversarial cases on every SIMD target, on one thread and
// on several, and compares them bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "edgewise/backend.h"
#include "edgewise/frontend.h"

namespace edgewise::randomized {

// Every `of`-th case of a seed's sequence: case k of the shard is number index + k of.
struct Shard {
  std::uint64_t index = 0, of = 1;
};
inline constexpr std::uint64_t kMostShards = 1 << 20;  // so that case numbers fit 64 bits

struct Report {
  std::uint64_t cases = 0;
  std::uint64_t frames = 0;          // drawn, and compared
  std::uint64_t triangles = 0;       // in them
  std::uint64_t pixels = 0;          // in them
  std::uint64_t oracle_frames = 0;   // of these frames, those that the oracle judged
  std::uint64_t frontend_lists = 0;  // of triangles, made by the front end, and compared
  std::uint64_t differences = 0;     // frames and lists that differ
  double seconds = 0.0;
  std::vector<std::string> findings;  // the first kMostFindings differences, and the exception, in words
};
inline constexpr std::size_t kMostFindings = 20;

struct Plan {
  // The first backend, on one thread and the scalar target, is the reference for all frames; the oracle
  // checks the reference itself.
  std::vector<BackendInfo> backends;
  // The front end's reference is its path for single triangles, without SIMD and threads.
  std::function<std::span<const ScreenTriangle>(Frontend&, const Drawable&, const FrontendOptions&,
                                                const Execution&)>
      frontend = &Frontend::run;
  std::uint64_t seed = 1;
  Shard shard;
  std::uint64_t cases = std::numeric_limits<std::uint64_t>::max();  // the most
  double seconds = std::numeric_limits<double>::infinity();         // no case or reduction step begins later
  std::filesystem::path failure_folder;  // for .tri files, created when needed; empty: none
  // Called before each case, and during the search for the fewest triangles that show a difference.
  std::function<bool()> stop = [] { return false; };
  std::function<void(const std::string&)> on_finding = [](const std::string&) {};
  std::function<void(const Report&)> on_progress = [](const Report&) {};
};

// Throws std::runtime_error that names the case. `report` then holds the results until there.
void run(const Plan& plan, Report& report);

// "Seed 7, shard 3/64: 1,234 cases …"
std::string summary(const Report& report, const Plan& plan);

// A line for scripts/reporting/shards.py, with the description of the machine that drew.
nlohmann::json to_json(const Report& report, const Plan& plan, const nlohmann::json& machine);

}  // namespace edgewise::randomized

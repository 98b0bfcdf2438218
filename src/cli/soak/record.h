// What a soak leaves behind: which cases were drawn and what came out, as JSON that can be continued and
// added up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/soak/tally.h"

namespace edgewise::soak {

// Every `of`-th case of a seed's sequence, from case `index` on: case k of the shard is number index + k of.
struct Shard {
  std::uint64_t index = 0, of = 1;
  std::uint64_t cases = 0;  // done

  std::uint64_t number(std::uint64_t k) const { return index + k * of; }
  bool operator==(const Shard&) const = default;
};
inline constexpr std::uint64_t kMostShards = std::uint64_t{1} << 40;

// Have they a finished case in common?
bool overlap(const Shard& a, const Shard& b);

struct Record {
  std::uint64_t seed = 1;
  std::vector<Shard> shards;
  Tally tally;
  double seconds = 0.0;                  // of all runs together
  std::vector<std::string> backends;     // the reference first
  std::vector<nlohmann::json> findings;  // at most kMostFindings
  std::vector<nlohmann::json> machines;  // those that drew, each once
};
inline constexpr std::size_t kMostFindings = 20;

// A record of this program on this machine, with nothing done yet.
Record new_record(std::uint64_t seed, const Shard& shard, const std::vector<std::string>& backends);

nlohmann::json to_json(const Record& record);

// The rates of differences that none in `trials` excludes with 95 % confidence; at most 1.
double bound_on(std::uint64_t trials);

// Is there a file that a soak wrote, whole or not, of whatever sequence?
bool is_record(const std::filesystem::path& path);

// Throws std::runtime_error that names the file: missing, no JSON, no record of a soak, or one of another
// sequence of cases.
Record read_record(const std::filesystem::path& path);

// Throws std::invalid_argument that says why two records don't add up: different seeds, programs (version and
// commit) or backends, or cases that are in both.
void merge(Record& record, const Record& other);

// A record of one shard, to go on where it ended, with `fresh` (see new_record) saying who goes on. Throws
// std::invalid_argument if that is not the same soak.
Record continued(Record record, const Record& fresh);

}  // namespace edgewise::soak

// The record of a soak test: the cases drawn and their results, as JSON that can be continued and merged.
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

// Whether two shards share a finished case.
bool overlap(const Shard& a, const Shard& b);

struct Record {
  std::uint64_t seed = 1;
  std::vector<Shard> shards;
  Tally tally;
  double seconds = 0.0;                  // sum over all runs
  std::vector<std::string> backends;     // the reference first
  std::vector<nlohmann::json> findings;  // at most kMostFindings
  std::vector<nlohmann::json> machines;  // descriptions of the machines that drew, without duplicates
};
inline constexpr std::size_t kMostFindings = 20;

// An empty record of this program on this machine.
Record new_record(std::uint64_t seed, const Shard& shard, const std::vector<std::string>& backends);

nlohmann::json to_json(const Record& record);

// The 95 % upper bound of the difference rate after no difference in `trials`; at most 1.
double bound_on(std::uint64_t trials);

// Whether the file is a record of a soak test, complete or not, of any sequence.
bool is_record(const std::filesystem::path& path);

// Throws std::runtime_error that names the file if it is missing, not JSON, not a complete record, or of
// another sequence of cases.
Record read_record(const std::filesystem::path& path);

// Adds `other` to `record`. Throws std::invalid_argument with the reason if they cannot be merged: different
// seeds, programs (version and commit) or backends, or shared cases.
void merge(Record& record, const Record& other);

// Prepares the record of one shard for continuation by the machine of `fresh` (see new_record). Throws
// std::invalid_argument unless both have the same shard, seed, program and backends.
Record continued(Record record, const Record& fresh);

}  // namespace edgewise::soak

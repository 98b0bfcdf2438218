#include "cli/soak/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <stdexcept>
#include <system_error>

#include "cli/soak/case.h"
#include "core/input_file.h"
#include "lab/method.h"
#include "support/machine.h"

namespace edgewise::soak {

namespace {

constexpr const char* kFormat = "edgewise soak";

std::string program_of(const nlohmann::json& machine) {
  return fmt::format("version {}, commit {}", machine.at("edgewise_version").get<std::string>(),
                     machine.at("commit").get<std::string>());
}

nlohmann::json counts_json(const Tally& tally) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [category, counts] : tally.by)
    for (const auto& [label, count] : counts)
      json[category][label] = {{"compared", count.compared}, {"differ", count.differ}};
  return json;
}

// Null if anything differs: then the observed rates are the estimate.
nlohmann::json bounds_json(const Tally& tally) {
  if (tally.differences() != 0 || tally.cases == 0) return nullptr;
  return {
      {"per_case", bound_on(tally.cases)},
      {"per_frame", bound_on(tally.frames)},
      {"per_pixel", bound_on(tally.pixels)},
      {"assumes",
       "if n independent trials show no difference, the rate is below 3 / n with 95 % confidence; cases are "
       "drawn independently from the soak test's own distribution, but frames of one case, and pixels of one "
       "frame, show the same triangles, so the bounds per frame and per pixel also assume that these fail "
       "independently"}};
}

// Rejects negative and fractional numbers, which the JSON library would convert silently.
std::uint64_t count_in(const nlohmann::json& json, const char* key) {
  const nlohmann::json& value = json.at(key);
  if (!value.is_number_unsigned()) throw std::invalid_argument(fmt::format("'{}' is not a count", key));
  return value.get<std::uint64_t>();
}

Shard shard_from(const nlohmann::json& json) {
  const Shard shard{count_in(json, "shard"), count_in(json, "of"), count_in(json, "cases")};
  constexpr std::uint64_t kEnd = std::uint64_t{1} << 63;
  if (shard.of == 0 || shard.of > kMostShards || shard.index >= shard.of || shard.cases >= kEnd / shard.of)
    throw std::invalid_argument("an impossible shard");
  return shard;
}

std::string name_of(const Shard& shard) {
  return fmt::format("{}/{}", shard.index, shard.of);
}

void check_disjoint(std::span<const Shard> these, std::span<const Shard> those) {
  for (const Shard& a : these)
    for (const Shard& b : those)
      if (overlap(a, b))
        throw std::invalid_argument(
            fmt::format("the same cases were drawn twice, in shards {} and {}", name_of(a), name_of(b)));
}

Tally tally_from(const nlohmann::json& json) {
  Tally tally;
  tally.cases = count_in(json, "cases");
  tally.frames = count_in(json, "frames");
  tally.triangles = count_in(json, "triangles");
  tally.pixels = count_in(json, "pixels");
  tally.oracle_frames = count_in(json, "oracle_frames");
  tally.frontend_lists = count_in(json, "frontend_lists");
  tally.frames_differ = count_in(json, "frames_differ");
  tally.frontend_lists_differ = count_in(json, "frontend_lists_differ");
  for (const auto& [category, counts] : json.at("by").items())
    for (const auto& [label, count] : counts.items())
      tally.by[category][label] = {count_in(count, "compared"), count_in(count, "differ")};
  return tally;
}

Record record_from(const nlohmann::json& json) {
  Record record;
  record.seed = count_in(json, "seed");
  for (const auto& shard : json.at("shards")) record.shards.push_back(shard_from(shard));
  for (auto a = record.shards.begin(); a != record.shards.end(); ++a)
    check_disjoint({a, 1}, {a + 1, record.shards.end()});
  record.tally = tally_from(json);
  json.at("seconds").get_to(record.seconds);
  if (!(record.seconds >= 0.0 && record.seconds <= 1e12)) throw std::invalid_argument("an impossible time");
  json.at("backends").get_to(record.backends);
  json.at("findings").get_to(record.findings);
  json.at("machines").get_to(record.machines);
  if (record.shards.empty() || record.backends.empty() || record.machines.empty())
    throw std::invalid_argument("it has no shards, no backends or no machines");
  for (const auto& machine : record.machines) program_of(machine);
  const auto cases = std::accumulate(record.shards.begin(), record.shards.end(), std::uint64_t{0},
                                     [](std::uint64_t sum, const Shard& s) { return sum + s.cases; });
  if (cases != record.tally.cases) throw std::invalid_argument("the shards' cases don't add up");
  return record;
}

// Null if the file is not a record of a soak test.
nlohmann::json parse(const std::filesystem::path& path) {
  InputFile file = open_input(path);
  nlohmann::json json = nlohmann::json::parse(file.stream, nullptr, false);
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) return nullptr;
  return json;
}

void add_machine(std::vector<nlohmann::json>& machines, const nlohmann::json& machine) {
  if (std::find(machines.begin(), machines.end(), machine) == machines.end()) machines.push_back(machine);
}

void check_alike(const Record& a, const Record& b) {
  if (a.seed != b.seed)
    throw std::invalid_argument(fmt::format("they have different seeds, {} and {}", a.seed, b.seed));
  const std::string program = program_of(a.machines.front()), other = program_of(b.machines.front());
  if (program != other)
    throw std::invalid_argument(fmt::format("they come from different programs: {}, and {}", program, other));
  if (a.backends != b.backends) throw std::invalid_argument("they compared different backends");
}

}  // namespace

double bound_on(std::uint64_t trials) {
  return std::min(1.0, lab::rate_bound(trials));
}

bool overlap(const Shard& a, const Shard& b) {
  if (a.cases > b.cases) return overlap(b, a);
  const std::uint64_t apart = a.index > b.index ? a.index - b.index : b.index - a.index;
  if (apart % std::gcd(a.of, b.of) != 0) return false;  // no common number
  const auto holds = [](const Shard& s, std::uint64_t number) {
    return number >= s.index && (number - s.index) % s.of == 0 && (number - s.index) / s.of < s.cases;
  };
  if (a.of == b.of) return a.cases > 0;
  for (std::uint64_t k = 0; k < a.cases; ++k)
    if (holds(b, a.number(k))) return true;
  return false;
}

Record new_record(std::uint64_t seed, const Shard& shard, const std::vector<std::string>& backends) {
  Record record;
  record.seed = seed;
  record.shards = {shard};
  record.backends = backends;
  record.machines = {tools::machine_description()};
  return record;
}

nlohmann::json to_json(const Record& r) {
  nlohmann::json json{{"format", kFormat},
                      {"sequence", kSequence},
                      {"seed", r.seed},
                      {"shards", nlohmann::json::array()},
                      {"backends", r.backends},
                      {"seconds", r.seconds},
                      {"cases", r.tally.cases},
                      {"frames", r.tally.frames},
                      {"triangles", r.tally.triangles},
                      {"pixels", r.tally.pixels},
                      {"oracle_frames", r.tally.oracle_frames},
                      {"frontend_lists", r.tally.frontend_lists},
                      {"frames_differ", r.tally.frames_differ},
                      {"frontend_lists_differ", r.tally.frontend_lists_differ},
                      {"differences", r.tally.differences()},
                      {"bounds_95", bounds_json(r.tally)},
                      {"by", counts_json(r.tally)},
                      {"findings", r.findings},
                      {"machines", r.machines}};
  for (const Shard& s : r.shards)
    json["shards"].push_back({{"shard", s.index}, {"of", s.of}, {"cases", s.cases}});
  return json;
}

bool is_record(const std::filesystem::path& path) {
  std::error_code missing;
  return std::filesystem::is_regular_file(path, missing) && !parse(path).is_null();
}

Record read_record(const std::filesystem::path& path) {
  const nlohmann::json json = parse(path);
  if (json.is_null()) throw file_error(path, "is not a record of a soak test");
  if (!json.contains("sequence") || json["sequence"] != kSequence)
    throw file_error(path, fmt::format("has another sequence of cases; this program's is {}", kSequence));
  try {
    return record_from(json);
  } catch (const std::exception& error) {
    throw file_error(path, fmt::format("is not a complete record of a soak test: {}", error.what()));
  }
}

Record continued(Record record, const Record& fresh) {
  if (record.shards.size() != 1)
    throw std::invalid_argument("it was merged from several shards and cannot be continued");
  check_alike(record, fresh);
  const Shard &mine = record.shards.front(), &wanted = fresh.shards.front();
  if (mine.index != wanted.index || mine.of != wanted.of)
    throw std::invalid_argument(fmt::format("it holds shard {}, not {}", name_of(mine), name_of(wanted)));
  for (const auto& machine : fresh.machines) add_machine(record.machines, machine);
  return record;
}

void merge(Record& record, const Record& other) {
  check_alike(record, other);
  check_disjoint(record.shards, other.shards);
  record.shards.insert(record.shards.end(), other.shards.begin(), other.shards.end());
  std::sort(record.shards.begin(), record.shards.end(),
            [](const Shard& a, const Shard& b) { return a.of != b.of ? a.of < b.of : a.index < b.index; });
  record.tally += other.tally;
  record.seconds += other.seconds;
  for (const auto& finding : other.findings)
    if (record.findings.size() < kMostFindings) record.findings.push_back(finding);
  for (const auto& machine : other.machines) add_machine(record.machines, machine);
}

}  // namespace edgewise::soak

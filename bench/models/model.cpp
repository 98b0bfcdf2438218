#include "bench/models/model.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/json_text.h"

namespace edgewise::bench {

namespace {

constexpr double kMs = 1e3;

nlohmann::ordered_json scheduled_json(const Row& row, double barrier_s) {
  const FrameWork& frame = row.recorded;
  const PathPart longest = frame.longest_part();
  return {{"name", row.name},
          {"cores", row.cores},
          {"estimate_ms", frame.time_s(row.cores, barrier_s) * kMs},
          {"work_ms", frame.work_s() * kMs},
          {"path_ms", frame.path_s() * kMs},
          {"longest", longest.name},
          {"longest_ms", longest.time_s * kMs},
          {"barrier_ms", barrier_s * kMs}};
}

nlohmann::ordered_json cost_json(const Row& row) {
  const FrameCost& cost = *row.cost;
  return {{"name", row.name},
          {"covered_blocks", cost.blocks.covered},
          {"won_blocks", cost.blocks.won},
          {"read_ms", cost.read_s * kMs},
          {"blocks_ms", cost.blocks_s * kMs},
          {"write_ms", cost.write_s * kMs},
          {"tiles_ms", cost.tiles_s * kMs}};
}

// A list per figure, with an element per round.
nlohmann::ordered_json second_thread_json(const Row& row) {
  nlohmann::ordered_json json{{"name", row.name}};
  const auto add = [&](const char* key, double time_s) {
    json[key].push_back(std::round(time_s * 1e9) / 1e6);  // whole nanoseconds
  };
  for (const auto& [one_s, two_s, waits] : row.second_thread) {
    add("one_ms", one_s);
    add("two_ms", two_s);
    add("serial_ms", waits.serial_s);
    add("start_ms", waits.start_s);
    add("between_ms", waits.between_s);
    add("turn_ms", waits.turn_s);
    add("end_ms", waits.end_s);
  }
  return json;
}

// One line per element.
std::string lines_of(const nlohmann::ordered_json& list) {
  std::string text;
  for (const auto& element : list) text += (text.empty() ? "\n" : ",\n") + tools::json_text(element);
  return text + "\n";
}

}  // namespace

std::string model_json(std::span<const Row> rows, double barrier_s) {
  auto scheduled = nlohmann::ordered_json::array(), costs = scheduled, second_thread = scheduled;
  for (const Row& row : rows) {
    if (!row.error.empty()) continue;
    if (row.cores > 0) scheduled.push_back(scheduled_json(row, barrier_s));
    if (row.cost) costs.push_back(cost_json(row));
    if (!row.second_thread.empty()) second_thread.push_back(second_thread_json(row));
  }
  return "{\n\"scheduled\": [" + lines_of(scheduled) + "],\n\"costs\": [" + lines_of(costs) +
         "],\n\"second_thread\": [" + lines_of(second_thread) + "]\n}\n";
}

}  // namespace edgewise::bench

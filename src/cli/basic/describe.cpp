#include "cli/basic/describe.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace edgewise::tools {

namespace {

struct Field {
  const char* key;
  std::uint64_t FrontendStats::*value;
  const char* meaning;  // in stats_text(); null: not listed there
};

constexpr std::array kFields = {
    Field{"meshes", &FrontendStats::meshes, nullptr},
    Field{"meshes_culled", &FrontendStats::meshes_culled, "meshes outside the view"},
    Field{"triangles", &FrontendStats::triangles, nullptr},
    Field{"whole_mesh", &FrontendStats::whole_mesh, "dropped with their mesh or cluster"},
    Field{"not_finite", &FrontendStats::not_finite, "dropped for NaN or infinite vertices"},
    Field{"outside", &FrontendStats::outside, "outside the view"},
    Field{"not_in_front", &FrontendStats::not_in_front, "behind the camera"},
    Field{"clipped_near", &FrontendStats::clipped_near, "cut by the near plane"},
    Field{"clipped_far", &FrontendStats::clipped_far, "cut by the far plane"},
    Field{"clipped_guard", &FrontendStats::clipped_guard, "cut by the guard band"},
    Field{"pieces", &FrontendStats::pieces, nullptr},
    Field{"culled", &FrontendStats::culled, "culled by facing"},
    Field{"zero_area", &FrontendStats::zero_area, "with zero area"},
    Field{"emitted", &FrontendStats::emitted, nullptr},
};

}  // namespace

nlohmann::json stats_json(const FrontendStats& stats) {
  nlohmann::json json;
  for (const Field& field : kFields) json[field.key] = stats.*field.value;
  return json;
}

std::string stats_text(const FrontendStats& stats) {
  std::string text = fmt::format("{} triangles, {} drawn", stats.triangles, stats.emitted);
  const char* separator = "; ";
  for (const Field& field : kFields)
    if (field.meaning != nullptr && stats.*field.value != 0) {
      text += fmt::format("{}{} {}", separator, stats.*field.value, field.meaning);
      separator = ", ";
    }
  return text;
}

std::string why_empty(const FrontendStats& stats) {
  if (stats.triangles == 0) return "there are no triangles";
  const std::pair<std::uint64_t, const char*> causes[] = {
      {stats.whole_mesh + stats.outside, "outside the view"},
      {stats.not_in_front, "behind the camera"},
      {stats.not_finite, "with NaN or infinite vertices"},
      {stats.culled, "culled by facing"},
      {stats.zero_area, "with zero area"},
      {stats.emitted, stats.emitted == 1 ? "that covers no pixel centre" : "that cover no pixel centre"}};
  std::string text;
  for (const auto& [count, cause] : causes) {
    if (count == 0) continue;
    const char* const noun = !text.empty() ? "" : count == 1 ? " triangle" : " triangles";
    text += fmt::format("{}{}{} {}", text.empty() ? "" : ", ", count, noun, cause);
  }
  return text;
}

}  // namespace edgewise::tools

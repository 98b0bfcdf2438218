#include "cli/describe.h"

#include <fmt/format.h>

#include <array>

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

}  // namespace edgewise::tools

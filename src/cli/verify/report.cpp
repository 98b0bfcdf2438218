#include "cli/verify/verify.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "support/console.h"

namespace edgewise::tools {

namespace {

std::string_view name_of_payload(Payload payload) {
  return payload == Payload::colour ? "colour" : "id";
}

std::string explain(const Mismatch& m) {
  std::string text = fmt::format(
      "  {} ({}{}) differs from {} in {} of {}x{} pixels, cull {}, payload {}\n", m.backend,
      tools::describe(m.drawn.how), m.drawn.whole_frame ? ", whole frame" : "", m.judge, m.found.pixels,
      m.frontend.width, m.frontend.height, name_of(m.frontend.cull), name_of_payload(m.frontend.payload));
  if (m.found.outside != 0) text += fmt::format("    words written beside the image: {}\n", m.found.outside);
  if (!m.values.empty())
    text += fmt::format("    the first is x {}, y {}, where depth and payload are\n", m.found.first_x,
                        m.found.first_y);
  for (const PixelValue& v : m.values)
    text += fmt::format("      {:<24} {:#010x} {:#010x}\n", v.drawn_by, v.depth, v.payload);
  for (const std::string& file : m.files) text += fmt::format("    {}\n", printable(file));
  if (!m.file_error.empty()) text += fmt::format("    pictures are missing: {}\n", printable(m.file_error));
  return text;
}

std::string names_of(const VerifyPlan& plan) {
  std::string names;
  for (const BackendInfo& backend : plan.backends)
    names += (names.empty() ? "" : ", ") + std::string(backend.name);
  return names;
}

nlohmann::json scene_json(const SceneVerdict& v) {
  nlohmann::json json{
      {"scene", v.scene},
      {"configurations", v.configurations},
      {"differing_pixels", v.differing_pixels},
      {"written_outside", v.written_outside},
      {"oracle", {{"configurations", v.oracle_configurations}, {"differing_pixels", v.oracle_differences}}},
      {"ok", v.ok()}};
  for (const HitCount& h : v.hits) json["pixels_not_hit_once"][h.backend] = h.not_once;
  json["mismatches"] = nlohmann::json::array();
  for (const Mismatch& m : v.mismatches) json["mismatches"].push_back(explain(m));
  return json;
}

}  // namespace

std::string describe(const lab::DrawOptions& how) {
  const Execution& e = how.execution;
  const std::string tiles = lab::describe(how.tiles);
  return fmt::format("{} thread{}, {}, tile {}{}{}", e.threads, e.threads == 1 ? "" : "s",
                     name_of(resolve(e.target)), e.tile_size, tiles.empty() ? "" : ", ", tiles);
}

constexpr const char* kLine = "{:<12} {:>9} {:>9} {:>8} {:>6} {:>6} {}\n";

std::string verify_header() {
  return fmt::format(kLine, "scene", "size", "triangles", "compared", "differ", "oracle", "verdict");
}

std::string verify_line(const SceneVerdict& v) {
  return fmt::format(kLine, printable_within(v.scene, 12), fmt::format("{}x{}", v.width, v.height),
                     v.triangles, v.configurations, v.differing_pixels, v.oracle_differences,
                     v.ok() ? "ok" : "DIFFERS");
}

std::string explain(const SceneVerdict& verdict) {
  std::string text;
  for (const Mismatch& m : verdict.mismatches) text += explain(m);
  for (const HitCount& h : verdict.hits)
    if (h.not_once != 0)
      text += fmt::format("  {} draws {} pixels not exactly once\n", h.backend, h.not_once);
  return text;
}

std::string summary(const VerifyReport& report, const VerifyPlan& plan) {
  std::uint64_t configurations = 0, oracle = 0;
  int differing_scenes = 0;
  std::string once;
  for (const SceneVerdict& v : report.scenes) {
    configurations += v.configurations;
    oracle += v.oracle_configurations;
    differing_scenes += v.ok() ? 0 : 1;
    if (!v.hits.empty() && v.ok()) once += (once.empty() ? "" : ", ") + printable(v.scene);
  }
  std::string text;
  if (!once.empty()) text += fmt::format("{}: every pixel drawn exactly once by {}.\n", once, names_of(plan));
  text += fmt::format("{} frames compared with {}, {} with the oracle: ", configurations,
                      plan.backends.front().name, oracle);
  return text + (report.ok()
                     ? "no bit differs.\n"
                     : fmt::format("{} scene{} DIFFER{}.\n", differing_scenes,
                                   differing_scenes == 1 ? "" : "s", differing_scenes == 1 ? "S" : ""));
}

nlohmann::json report_json(const VerifyReport& report, const VerifyPlan& plan) {
  nlohmann::json json{{"full", plan.full}, {"subpixel_bits", plan.subpixel_bits}, {"ok", report.ok()}};
  for (const BackendInfo& backend : plan.backends) json["backends"].push_back(backend.name);
  json["threads"] = plan.threads;
  for (const SimdTarget target : supported_targets()) json["simd_targets"].push_back(name_of(target));
  json["scenes"] = nlohmann::json::array();
  for (const SceneVerdict& verdict : report.scenes) json["scenes"].push_back(scene_json(verdict));
  return json;
}

}  // namespace edgewise::tools

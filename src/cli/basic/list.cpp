// `edgewise list` lists scenes, backends, SIMD targets and culling modes. `edgewise machine` describes the
// machine and the build, as every result file does.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/frontend.h"
#include "support/console.h"
#include "support/json.h"
#include "support/machine.h"

namespace edgewise::tools {

namespace {

std::string_view summary_of(Cull cull) {
  constexpr std::string_view kSummaries[] = {
      "draws all faces", "culls back faces (counter-clockwise on the screen)",
      "culls front faces (clockwise on the screen)", "culls all faces"};
  return kSummaries[static_cast<std::size_t>(cull)];
}

// The backends, and with `all` the other compositions.
std::vector<BackendInfo> backend_list(bool all) {
  std::vector<BackendInfo> list(backends().begin(), backends().end());
  if (all) list.insert(list.end(), compositions().begin(), compositions().end());
  return list;
}

nlohmann::json lists_as_json(bool all) {
  nlohmann::json lists;
  for (const SceneInfo& scene : builtin_scenes())
    lists["scenes"].push_back({{"name", scene.name}, {"summary", scene.summary}, {"stream", scene.stream}});
  for (const BackendInfo& backend : backend_list(all))
    lists["backends"].push_back({{"name", backend.name}, {"summary", backend.summary}});
  for (const SimdTarget target : supported_targets()) lists["simd_targets"].push_back(name_of(target));
  lists["simd_best"] = name_of(resolve(SimdTarget::best));
  for (const Cull cull : cull_modes())
    lists["cull_modes"].push_back({{"name", name_of(cull)}, {"summary", summary_of(cull)}});
  return lists;
}

std::string lists_as_text(bool all) {
  const auto line = [](std::string_view name, std::string_view summary) {
    return summary.empty() ? fmt::format("  {}\n", name) : fmt::format("  {:<21} {}\n", name, summary);
  };
  std::string text;
  for (const bool streams : {false, true}) {
    text += streams ? "Scenes that are streams of screen triangles:\n" : "Scenes:\n";
    for (const SceneInfo& scene : builtin_scenes())
      if (scene.stream == streams) text += line(scene.name, scene.summary);
  }
  text += "Files that can replace a scene name:\n" + line("*.obj", "Wavefront meshes");
  text += line("*.tri", "triangle streams, written by edgewise capture");
  text += line("-", "standard input, with either of them");
  text += "Backends, the reference first:\n";
  for (const BackendInfo& backend : backend_list(all)) text += line(backend.name, backend.summary);
  text += "SIMD targets of this machine:\n";
  for (const SimdTarget target : supported_targets())
    text += line(name_of(target), target == resolve(SimdTarget::best) ? "best" : "");
  text += "Culling modes:\n";
  for (const Cull cull : cull_modes()) text += line(name_of(cull), summary_of(cull));
  return text;
}

}  // namespace

Action add_list(CLI::App& command) {
  const auto in_json = std::make_shared<bool>(false);
  command.add_flag("--json", *in_json, "Print JSON");
  const auto all = std::make_shared<bool>(false);
  command.add_flag("--all", *all, "Also list compositions of the backends' parts");
  return [in_json, all] {
    print(*in_json ? json_text(lists_as_json(*all), 2) + "\n" : lists_as_text(*all));
    return kDone;
  };
}

Action add_machine(CLI::App& command) {
  const auto name_only = std::make_shared<bool>(false);
  command.add_flag("--name", *name_only, "Print only the name of this machine's folder below results/");
  return [name_only] {
    print((*name_only ? machine_name() : json_text(machine_description(), 2)) + "\n");
    return kDone;
  };
}

}  // namespace edgewise::tools

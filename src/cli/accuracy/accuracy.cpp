#include "cli/accuracy/accuracy.h"

#include <algorithm>
#include <stdexcept>

#include "cli/accuracy/score.h"
#include "core/nearest_name.h"
#include "lab/peers/peer.h"
#include "support/console.h"
#include "support/options.h"

namespace edgewise::tools {

namespace {

template <typename Methods, typename Chosen>
void choose(const AccuracyPlan& plan, Family family, const Methods& all, Chosen& chosen) {
  if (plan.family && *plan.family != family) return;
  for (const auto& method : all)
    if (plan.methods.empty() ||
        std::find(plan.methods.begin(), plan.methods.end(), method.info.name) != plan.methods.end())
      chosen.push_back(&method);
}

void check_method_names(const AccuracyPlan& plan) {
  AccuracyPlan everything;
  everything.family = plan.family;
  everything.peers = plan.peers;
  std::vector<std::string_view> known;
  for (const auto& [family, info] : methods_of(everything).all()) known.push_back(info->name);
  for (const std::string& name : plan.methods)
    find_named("method", name, std::span<const std::string_view>(known), std::identity());
}

// Those that start here; the first call names the others on stderr.
const std::vector<lab::CoverageMethod>& started_peers() {
  static const lab::StartedPeers started = [] {
    lab::StartedPeers found = lab::start_peers(lab::peers());
    found.require_one();
    for (const std::string& reason : found.left_out) print_error("left out: " + reason);
    return found;
  }();
  static const std::vector<lab::CoverageMethod> methods = lab::peer_methods(started);
  return methods;
}

// False for two scenes made for speed. knots repeats torus-knot. Half the edges of quads pass through pixel
// centres, so quads would dominate every rate summed over all scenes.
bool is_judged_by_default(const lab::LabScene& scene) {
  return scene.name != "quads" && scene.name != "knots";
}

std::vector<lab::LabScene> scenes_of_file(const std::string& path, const AccuracyPlan& plan) {
  check_source(path);
  const auto load = [path, fit = plan.fit] {
    SceneOptions options;
    options.fit = fit;
    Shot shot = load_shot(path, options, 0.0);
    return lab::SizedDrawable{std::move(shot.source.drawable), {shot.frontend.width, shot.frontend.height}};
  };
  return lab::own_scenes(source_name(path), is_stream_file(path), load, plan.subpixel_bits);
}

[[noreturn]] void reject(const std::string& name, const std::vector<lab::LabScene>& known) {
  std::vector<std::string_view> names;
  for (const lab::LabScene& scene : known)
    if (std::find(names.begin(), names.end(), scene.name) == names.end()) names.push_back(scene.name);
  names.push_back(kTurningCube);
  names.push_back(kChoice);
  throw std::invalid_argument(unknown_name("scene", name, names));
}

class Run {
 public:
  explicit Run(const AccuracyPlan& plan) : plan_(plan) {
    check_method_names(plan);
    methods_ = methods_of(plan);
    chosen_ = scenes_of(plan);
    std::erase_if(chosen_.scenes, [&](const lab::LabScene& scene) { return !methods_.has(scene.family); });
    chosen_.turning_cube = chosen_.turning_cube && !methods_.coverage.empty();
    chosen_.choice = chosen_.choice && !methods_.coverage.empty();
    if (chosen_.scenes.empty() && !chosen_.turning_cube && !chosen_.choice)
      throw std::invalid_argument("nothing to do: no selected method belongs to a selected scene's family");
  }

  AccuracyReport go() {
    AccuracyReport report;
    for (const lab::LabScene& scene : chosen_.scenes) {
      show(scene.name);
      const Judging judging{plan_, methods_, scene, report.closeups};
      SceneResult result{};
      result.family = scene.family, result.name = scene.name;
      if (scene.smallest) result.kind = SceneKind::small;
      std::visit([&](const auto& made) { judge(made, judging, result); }, scene.make());
      report.scenes.push_back(std::move(result));
    }
    if (chosen_.turning_cube) {
      show(kTurningCube);
      report.turning_cube = judge_turning_cube(plan_, methods_, report.closeups);
      report.motions = judge_motions(plan_, methods_);
    }
    if (chosen_.choice) {
      show(kChoice);
      report.choices = judge_choices(plan_, methods_);
    }
    return report;
  }

 private:
  void show(std::string_view scene) {
    const std::size_t all = chosen_.scenes.size() + chosen_.turning_cube + chosen_.choice;
    if (plan_.on_progress) plan_.on_progress(static_cast<double>(done_++) / static_cast<double>(all), scene);
  }

  const AccuracyPlan& plan_;
  ChosenMethods methods_;
  AccuracyScenes chosen_;
  std::size_t done_ = 0;
};

}  // namespace

// For exact coverage methods, no error against the snapped reference.
bool broke_promise(const MethodResult& method) {
  return std::visit(
      [&](const auto& s) {
        using Of = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<Of, CoverageScores>)
          return s.visible.unexplained != 0 ||
                 (method.exact && (s.snapped.errors() != 0 || s.snapped.out_of_bounds != 0));
        else if constexpr (std::is_same_v<Of, lab::ProjectionScore>)
          return method.exact && s.by_projection != 0;
        else
          return s.broken != 0;
      },
      method.score);
}

bool ChosenMethods::has(Family family) const {
  return std::ranges::any_of(all(), [&](const auto& method) { return method.first == family; });
}

std::vector<std::pair<Family, const lab::MethodInfo*>> ChosenMethods::all() const {
  std::vector<std::pair<Family, const lab::MethodInfo*>> list;
  for (const auto* method : coverage) list.emplace_back(Family::coverage, &method->info);
  for (const auto* method : visibility) list.emplace_back(Family::visibility, &method->info);
  for (const auto* method : facing) list.emplace_back(Family::facing, &method->info);
  for (const auto* method : clipping) list.emplace_back(Family::clipping, &method->info);
  for (const auto* method : projection) list.emplace_back(Family::projection, &method->info);
  return list;
}

ChosenMethods methods_of(const AccuracyPlan& plan) {
  ChosenMethods chosen;
  if (plan.peers) {
    choose(plan, Family::coverage, started_peers(), chosen.coverage);
    return chosen;
  }
  choose(plan, Family::coverage, lab::coverage_methods(), chosen.coverage);
  choose(plan, Family::visibility, lab::visibility_methods(), chosen.visibility);
  choose(plan, Family::facing, lab::facing_methods(), chosen.facing);
  choose(plan, Family::clipping, lab::clipping_methods(), chosen.clipping);
  choose(plan, Family::projection, lab::projection_methods(), chosen.projection);
  return chosen;
}

AccuracyScenes scenes_of(const AccuracyPlan& plan) {
  if (plan.peers) {
    if (std::ranges::any_of(plan.scenes, [](const std::string& name) { return name != kChoice; }))
      throw std::invalid_argument("--peers measures the scene 'choice' only");
    return {.choice = true};
  }
  const std::vector<lab::LabScene> known = lab::lab_scenes(plan.quick, plan.subpixel_bits);
  AccuracyScenes chosen;
  chosen.turning_cube = chosen.choice = plan.scenes.empty();
  if (plan.scenes.empty())
    std::copy_if(known.begin(), known.end(), std::back_inserter(chosen.scenes), is_judged_by_default);
  std::vector<std::string> seen;
  for (const std::string& name : plan.scenes) {
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
    seen.push_back(name);
    std::vector<lab::LabScene> found;
    if (name == kTurningCube)
      chosen.turning_cube = true;
    else if (name == kChoice)
      chosen.choice = true;
    else if (is_file_path(name))
      found = scenes_of_file(name, plan);
    else
      std::copy_if(known.begin(), known.end(), std::back_inserter(found),
                   [&](const lab::LabScene& scene) { return scene.name == name; });
    if (found.empty() && name != kTurningCube && name != kChoice) reject(name, known);
    chosen.scenes.insert(chosen.scenes.end(), found.begin(), found.end());
  }
  if (plan.family) {
    std::erase_if(chosen.scenes, [&](const lab::LabScene& scene) { return scene.family != *plan.family; });
    chosen.turning_cube = chosen.turning_cube && plan.family == Family::coverage;
    chosen.choice = chosen.choice && plan.family == Family::coverage;
  }
  std::stable_sort(chosen.scenes.begin(), chosen.scenes.end(),
                   [](const auto& a, const auto& b) { return a.family < b.family; });
  return chosen;
}

std::string closeup_name(Family family, std::string_view scene, std::string_view method) {
  return std::string(name_of(family)) + '-' + std::string(scene) + '-' + std::string(method);
}

bool AccuracyReport::ok() const {
  if (turning_cube)
    for (const CubeMethodResult& method : turning_cube->methods)
      if (method.exact && method.wrong_snapped != 0) return false;
  return std::all_of(scenes.begin(), scenes.end(), [](const SceneResult& scene) {
    return std::none_of(scene.methods.begin(), scene.methods.end(), broke_promise);
  });
}

AccuracyReport measure_accuracy(const AccuracyPlan& plan) {
  return Run(plan).go();
}

}  // namespace edgewise::tools

#include "cli/accuracy/scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/nearest_name.h"
#include "core/random.h"
#include "lab/coverage/coverage.h"
#include "support/options.h"

namespace edgewise::tools {

namespace {

constexpr lab::Size kFullHd{1920, 1080}, kNormalSize{960, 540}, kQuick{480, 270};
enum class Timed { never, full, always };  // full: not in a quick run

// The size and scale at which a built-in scene is judged. Judging all methods on full scenes would take too
// long.
struct SceneExtent {
  std::string_view name;
  lab::Size size, quick_size;
  double scale, quick_scale;  // of scalable scenes
  Timed timed;
  double cost_s, quick_cost_s;
};
constexpr SceneExtent kExtents[] = {
    {"torus-knot", kFullHd, kFullHd, 1, 1, Timed::always, 3.4, 2.2},
    {"medium", kFullHd, kNormalSize, 0.15, 0.1, Timed::never, 2, 0.5},
    {"small", kFullHd, kNormalSize, 0.15, 0.05, Timed::never, 2.5, 0.5},
    {"micro", kFullHd, kNormalSize, 0.15, 0.05, Timed::never, 2, 0.5},
    {"large", kFullHd, kNormalSize, 0.4, 0.1, Timed::never, 1, 0.3},
    {"sliver", kFullHd, kNormalSize, 0.02, 0.02, Timed::never, 2, 1},
    {"knots", kFullHd, kNormalSize, 0.1, 0.02, Timed::never, 4, 1},
};
constexpr SceneExtent kNormalExtent{"", kFullHd, kNormalSize, 1, 1, Timed::never, 1, 0.3};

SceneExtent extent_of(std::string_view name) {
  for (const SceneExtent& extent : kExtents)
    if (extent.name == name) return extent;
  return kNormalExtent;
}

// Intersecting triangles at distances from 30 to 900: a hard case for every sort order and every depth
// format.
Scene deep_soup(int count) {
  Scene scene;
  scene.camera.near_z = 0.1f;
  scene.camera.far_z = 1000.0f;
  scene.instances.resize(1);
  Mesh& mesh = scene.meshes.emplace_back();
  Random random(11);
  for (int i = 0; i < count; ++i) {
    const auto within = [&](float reach) { return random.uniform(-reach, reach); };
    // Uniform in 1 / distance^2: the number of triangles per distance falls as 1 / distance^3.
    const float distance = 900.0f / std::sqrt(random.uniform(1.0f, 900.0f));
    const float centre_y = within(0.6f * distance);
    const glm::vec3 centre(within(distance), centre_y, -distance);
    const auto first = static_cast<unsigned>(mesh.positions.size());
    const float side = 0.08f * distance;
    for (int k = 0; k < 3; ++k) {
      const float z = within(side), y = within(side);
      mesh.positions.push_back(centre + glm::vec3(within(side), y, z));
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.colours.push_back(rgb(200, 200, 200));
  }
  return scene;
}

// Triangles on all sides of the camera: small ones, large ones that reach behind it and out of the view, and
// tiny ones in front of the near plane.
lab::ClippingScene around_the_camera(int count, lab::Size size) {
  lab::ClippingScene s{{}, size};
  s.scene.meshes.resize(1);
  s.scene.instances.resize(1);
  s.scene.camera.near_z = 0.5f;
  s.scene.camera.far_z = 50.0f;
  Mesh& mesh = s.scene.meshes.front();
  Random random(9);
  for (int i = 0; i < count; ++i) {
    const auto inside = [&](float reach) {
      const float z = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
      return glm::vec3(random.uniform(-reach, reach), y, z);
    };
    const int kind = i % 200;
    const float away = kind == 0 ? 0.4f : kind == 1 ? 60.0f : 16.0f;
    const float side = kind == 0 ? 0.1f : kind == 1 ? 12.0f : kind < 5 ? 6.0f : 0.5f;
    const glm::vec3 centre = inside(away);
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(centre + inside(side));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.colours.push_back(rgb(200, 200, 200));
  }
  return s;
}

lab::CoverageScene scene_of(const Drawable& drawable, lab::Size size) {
  const Cull cull = std::holds_alternative<TriangleStream>(drawable) ? Cull::none : Cull::back;
  return lab::coverage_scene(drawable, {size.width, size.height, cull, false});
}

class Catalogue {
 public:
  explicit Catalogue(const AccuracyPlan& plan) : plan_(plan) {}

  std::vector<AccuracyScene> built_in() {
    // First, because the speed charts use it: a scene on which both references agree.
    for (const lab::CoverageCase& c : lab::coverage_cases()) {
      const bool small = c.size.width < 1000;
      const Timed timed = c.name == "mesh_on_grid" ? Timed::always
                          : c.name == "mesh"       ? Timed::full
                                                   : Timed::never;
      const double cost_s = small ? 0.1 : plan_.quick ? 1.0 : 6.0;
      add(Family::coverage, c.name, c.summary, timed, small, cost_s, [&c] {
        auto floats = c.make();
        auto snapped = lab::snapped(floats);
        return lab::CoverageScene{c.size, std::move(floats), std::move(snapped)};
      });
    }
    const lab::Size seen = plan_.quick ? kQuick : kNormalSize;
    add(Family::visibility, "deep_soup", "20,000 intersecting triangles, near and far", Timed::always, false,
        plan_.quick ? 0.5 : 3.0, [seen] { return lab::visibility_scene(deep_soup(20'000), seen); });
    for (const SceneInfo& info : builtin_scenes()) add_built_in(info);
    for (const lab::VisibilityCase& c : lab::visibility_cases())
      add(Family::visibility, c.name, c.summary, Timed::never, true, 0.1, c.make);
    for (const lab::FacingCase& c : lab::facing_cases())
      add(Family::facing, c.name, c.summary, Timed::never, true, 0.1, c.make);
    add_facing();
    for (const lab::ClippingCase& c : lab::clipping_cases())
      add(Family::clipping, c.name, c.summary, Timed::never, true, 0.2, c.make);
    const bool quick = plan_.quick;
    add(Family::clipping, "around_the_eye", "triangles on all sides, across the near and the far plane",
        Timed::always, false, quick ? 2.0 : 5.0,
        [quick] { return quick ? around_the_camera(5000, kQuick) : around_the_camera(20'000, kNormalSize); });
    // Group by family, in the order of the tables.
    std::stable_sort(list_.begin(), list_.end(),
                     [](const auto& a, const auto& b) { return a.family < b.family; });
    return std::move(list_);
  }

  // The scenes of a user's file, always timed.
  std::vector<AccuracyScene> file(const std::string& path) {
    check_source(path);
    const bool mesh = !is_stream_file(path);
    const auto load = [path, fit = plan_.fit] {
      SceneOptions options;
      options.fit = fit;
      return load_shot(path, options, 0.0);
    };
    add(Family::coverage, source_name(path), "your file", Timed::always, false, 5.0, [load] {
      const Shot shot = load();
      return scene_of(shot.source.drawable, {shot.frontend.width, shot.frontend.height});
    });
    if (mesh)
      add(Family::visibility, source_name(path), "your file", Timed::always, false, 5.0, [load] {
        const Shot shot = load();
        return lab::visibility_scene(std::get<Scene>(shot.source.drawable),
                                     {shot.frontend.width, shot.frontend.height}, Cull::back);
      });
    return std::move(list_);
  }

 private:
  template <typename Make>
  void add(Family family, std::string_view name, std::string_view summary, Timed timed, bool small,
           double cost_s, Make make) {
    const bool now = plan_.speed && (timed == Timed::always || (timed == Timed::full && !plan_.quick));
    list_.push_back({family, std::string(name), std::string(summary), now, small, cost_s,
                     [make] { return AnyScene(make()); }});
  }

  void add_built_in(const SceneInfo& info) {
    const SceneExtent extent = extent_of(info.name);
    const lab::Size size = plan_.quick ? extent.quick_size : extent.size;
    const SceneRequest request{size.width, size.height, 0.0f,
                               plan_.quick ? extent.quick_scale : extent.scale};
    const double cost_s = plan_.quick ? extent.quick_cost_s : extent.cost_s;
    add(Family::coverage, info.name, info.summary, extent.timed, false, cost_s,
        [&info, request, size] { return scene_of(info.make(request), size); });
    if (info.stream) return;
    const lab::Size seen = plan_.quick ? kQuick : kNormalSize;
    const SceneRequest for_visibility{seen.width, seen.height, 0.0f, request.scale};
    add(Family::visibility, info.name, info.summary, Timed::never, false, cost_s / 2,
        [&info, for_visibility, seen] {
          return lab::visibility_scene(std::get<Scene>(info.make(for_visibility)), seen, Cull::back);
        });
  }

  void add_facing() {
    constexpr double kTilt = 0.5235987755982988;  // 30 degrees
    const std::size_t many = plan_.quick ? 20'000 : 100'000, some = plan_.quick ? 5'000 : 20'000;
    const double cost_s = plan_.quick ? 0.3 : 4.0;
    add(Family::facing, "tilted_faces", "many faces in random directions, 30 degrees off the axis",
        Timed::always, false, cost_s, [many] { return lab::tilted_faces(kTilt, true, many, 3); });
    add(Family::facing, "tilted_faces_orthographic", "the same under an orthographic camera", Timed::always,
        false, cost_s / 5, [some] { return lab::tilted_faces(kTilt, false, some, 3); });
    add(Family::facing, "edge_on_faces", "many slivers through pixel centres, almost edge-on", Timed::always,
        false, cost_s, [some] { return lab::edge_on_faces(true, some, 4); });
  }

  const AccuracyPlan& plan_;
  std::vector<AccuracyScene> list_;
};

// False for two scenes made for speed. knots repeats torus-knot. Half the edges of quads pass through pixel
// centres, so quads would dominate every rate summed over all scenes.
bool is_judged_by_default(const AccuracyScene& scene) {
  return scene.name != "quads" && scene.name != "knots";
}

[[noreturn]] void reject(const std::string& name, const std::vector<AccuracyScene>& known) {
  std::vector<std::string_view> names;
  for (const AccuracyScene& scene : known)
    if (std::find(names.begin(), names.end(), scene.name) == names.end()) names.push_back(scene.name);
  names.push_back(kTurningCube);
  throw std::invalid_argument(unknown_name("scene", name, names));
}

}  // namespace

AccuracyScenes scenes_of(const AccuracyPlan& plan) {
  const std::vector<AccuracyScene> known = Catalogue(plan).built_in();
  AccuracyScenes chosen;
  chosen.turning_cube = plan.scenes.empty();
  if (plan.scenes.empty())
    std::copy_if(known.begin(), known.end(), std::back_inserter(chosen.scenes), is_judged_by_default);
  std::vector<std::string> seen;
  for (const std::string& name : plan.scenes) {
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
    seen.push_back(name);
    std::vector<AccuracyScene> found;
    if (name == kTurningCube)
      chosen.turning_cube = true;
    else if (is_file_path(name))
      found = Catalogue(plan).file(name);
    else
      std::copy_if(known.begin(), known.end(), std::back_inserter(found),
                   [&](const AccuracyScene& scene) { return scene.name == name; });
    if (found.empty() && name != kTurningCube) reject(name, known);
    chosen.scenes.insert(chosen.scenes.end(), found.begin(), found.end());
  }
  if (plan.family) {
    std::erase_if(chosen.scenes, [&](const AccuracyScene& scene) { return scene.family != *plan.family; });
    chosen.turning_cube = chosen.turning_cube && plan.family == Family::coverage;
  }
  std::stable_sort(chosen.scenes.begin(), chosen.scenes.end(),
                   [](const auto& a, const auto& b) { return a.family < b.family; });
  return chosen;
}

}  // namespace edgewise::tools

#include "lab/scenes.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "edgewise/builtin.h"

namespace edgewise::lab {

namespace {

constexpr Size kFullHd{1920, 1080}, kNormalSize{960, 540}, kQuick{480, 270};

// The size and scale at which a built-in scene is judged. Judging all methods on full scenes would take too
// long.
struct SceneExtent {
  std::string_view name;
  Size size, quick_size;
  double scale, quick_scale;  // of scalable scenes
};
constexpr SceneExtent kExtents[] = {
    {"torus-knot", kFullHd, kFullHd, 1, 1},      {"medium", kFullHd, kNormalSize, 0.15, 0.1},
    {"small", kFullHd, kNormalSize, 0.15, 0.05}, {"micro", kFullHd, kNormalSize, 0.15, 0.05},
    {"large", kFullHd, kNormalSize, 0.4, 0.1},   {"sliver", kFullHd, kNormalSize, 0.02, 0.02},
    {"knots", kFullHd, kNormalSize, 0.1, 0.02},
};
constexpr SceneExtent kNormalExtent{"", kFullHd, kNormalSize, 1, 1};

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
ClippingScene around_the_camera(int count, Size size) {
  ClippingScene s{{}, size};
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

CoverageScene scene_of(const Drawable& drawable, Size size, int subpixel_bits) {
  return coverage_scene(drawable,
                        {.width = size.width,
                         .height = size.height,
                         .cull = std::holds_alternative<TriangleStream>(drawable) ? Cull::none : Cull::back,
                         .subpixel_bits = subpixel_bits});
}

class Catalogue {
 public:
  Catalogue(bool quick, int subpixel_bits) : quick_(quick), subpixel_bits_(subpixel_bits) {}

  std::vector<LabScene> built_in() {
    for (const CoverageCase& c : coverage_cases()) {
      const bool small = c.size.width < 1000;
      add(Family::coverage, c.name, small, [&c, bits = subpixel_bits_] {
        auto floats = c.make();
        auto rounded = snapped(floats, bits);
        return CoverageScene{c.size, std::move(floats), std::move(rounded), bits};
      });
    }
    const Size seen = quick_ ? kQuick : kNormalSize;
    add(Family::visibility, "deep_soup", false, [seen] { return visibility_scene(deep_soup(20'000), seen); });
    for (const SceneInfo& info : builtin_scenes()) add_built_in(info);
    add_projection("fine_sphere", quick_ ? kNormalSize : kFullHd, [quick = quick_](int frame) {
      Scene scene = quick ? sphere_scene(32, 48) : sphere_scene(128, 192);
      scene.instances.front().angle = static_cast<float>(frame);
      return scene;
    });
    for (const VisibilityCase& c : visibility_cases()) add(Family::visibility, c.name, true, c.make);
    for (const FacingCase& c : facing_cases()) add(Family::facing, c.name, true, c.make);
    add_facing();
    for (const ClippingCase& c : clipping_cases()) add(Family::clipping, c.name, true, c.make);
    add(Family::clipping, "around_the_eye", false, [quick = quick_] {
      return quick ? around_the_camera(5000, kQuick) : around_the_camera(20'000, kNormalSize);
    });
    // Group by family, in the order of the tables.
    std::stable_sort(list_.begin(), list_.end(),
                     [](const auto& a, const auto& b) { return a.family < b.family; });
    return std::move(list_);
  }

 private:
  template <typename Make>
  void add(Family family, std::string_view name, bool small, Make make) {
    list_.push_back({family, std::string(name), small, [make] { return AnyScene(make()); }});
  }

  void add_built_in(const SceneInfo& info) {
    const SceneExtent extent = extent_of(info.name);
    const Size size = quick_ ? extent.quick_size : extent.size;
    const SceneRequest request{size.width, size.height, 0.0f, quick_ ? extent.quick_scale : extent.scale};
    add(Family::coverage, info.name, false,
        [&info, request, size, bits = subpixel_bits_] { return scene_of(info.make(request), size, bits); });
    if (info.stream) return;
    const Size seen = quick_ ? kQuick : kNormalSize;
    const SceneRequest for_visibility{seen.width, seen.height, 0.0f, request.scale};
    add(Family::visibility, info.name, false, [&info, for_visibility, seen] {
      return visibility_scene(std::get<Scene>(info.make(for_visibility)), seen, Cull::back);
    });
    add_projection(info.name, size, [&info, request](int frame) {
      SceneRequest at = request;
      at.time = static_cast<float>(frame);
      return std::get<Scene>(info.make(at));
    });
  }

  void add_projection(std::string_view name, Size size, std::function<Scene(int)> make) {
    const int frames = quick_ ? 1 : 4;
    add(Family::projection, name, false, [size, frames, make] {
      return ProjectionScene{size, frames, make};
    });
  }

  void add_facing() {
    constexpr double kTilt = 0.5235987755982988;  // 30 degrees
    const std::size_t many = quick_ ? 20'000 : 100'000, some = quick_ ? 5'000 : 20'000;
    add(Family::facing, "tilted_faces", false, [many] { return tilted_faces(kTilt, true, many, 3); });
    add(Family::facing, "tilted_faces_orthographic", false,
        [some] { return tilted_faces(kTilt, false, some, 3); });
    add(Family::facing, "edge_on_faces", false, [some] { return edge_on_faces(true, some, 4); });
  }

  bool quick_;
  int subpixel_bits_;
  std::vector<LabScene> list_;
};

}  // namespace

std::vector<LabScene> lab_scenes(bool quick, int subpixel_bits) {
  return Catalogue(quick, subpixel_bits).built_in();
}

LabScene own_coverage_scene(const std::string& name, std::function<SizedDrawable()> load, int subpixel_bits) {
  return {Family::coverage, name, false, [load, subpixel_bits] {
            const SizedDrawable own = load();
            return AnyScene(scene_of(own.drawable, own.size, subpixel_bits));
          }};
}

std::vector<LabScene> own_scenes(const std::string& name, bool stream, std::function<SizedDrawable()> load,
                                 int subpixel_bits) {
  std::vector<LabScene> scenes{own_coverage_scene(name, load, subpixel_bits)};
  if (stream) return scenes;
  scenes.push_back({Family::visibility, name, false, [load] {
                      const SizedDrawable own = load();
                      return AnyScene(visibility_scene(std::get<Scene>(own.drawable), own.size, Cull::back));
                    }});
  scenes.push_back({Family::projection, name, false, [load] {
                      const SizedDrawable own = load();
                      return AnyScene(ProjectionScene{
                          own.size, 1, [scene = std::get<Scene>(own.drawable)](int) { return scene; }});
                    }});
  return scenes;
}

}  // namespace edgewise::lab

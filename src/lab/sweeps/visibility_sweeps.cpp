// Visibility sweeps: the distance between two planes, the number of bars in a cycle, the width of slivers.
#include <numbers>

#include "core/random.h"
#include "core/trigonometry.h"
#include "lab/sweeps/sweeps.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

namespace {

template <typename Errors>
Measured measure_scene(const VisibilityScene& scene, Errors&& errors) {
  const auto visible = true_visible_triangles(scene);
  return measured(visibility_methods(), [&](const VisibilityMethod& method) {
    // All methods draw the same snapped positions; the coverage sweeps measure the errors of snapping.
    const VisibilityScore s = score(method, scene, visible).snapped;
    return Tally{errors(s), s.covered};
  });
}

Measured measure_separation(double distance, double separation, std::uint64_t seed) {
  Random random(seed);
  return measure_scene(two_planes(distance, separation, 0.1, 1000, double{random.uniform(0.05f, 0.15f)}),
                       [](const VisibilityScore& s) { return s.wrong_triangle; });
}

// Bars around a ring. Each is broad and near the camera at its start, where it occludes the far tip of the
// previous one. With one or two bars the ring is open. `turn`: of the ring, in radians.
VisibilityScene ring_of_bars(int bars, double turn) {
  constexpr float kNear = 2, kFar = 4;
  const double step = 2 * std::numbers::pi / std::max(bars, 3);
  Scene scene;
  scene.camera.fov_y = static_cast<float>(2 * arctangent(1, 2));
  scene.camera.near_z = 0.5f, scene.camera.far_z = 10.0f;
  Mesh& mesh = scene.meshes.emplace_back();
  scene.instances.emplace_back();
  for (int bar = 0; bar < bars; ++bar) {
    // Angles in units of the step from bar to bar. Down the screen is -y.
    const auto add = [&](double angle, float radius, float z) {
      const auto at = static_cast<float>((bar + angle) * step + turn);
      mesh.positions.push_back(z * glm::vec3(radius * cosine(at), -radius * sine(at), -1.0f));
    };
    const auto first = static_cast<unsigned>(mesh.positions.size());
    add(-0.1, 0.40f, kNear);
    add(-0.1, 0.48f, kNear);
    add(1.3, 0.44f, kFar);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.colours.push_back(rgb(255, 255, 255));
  }
  return visibility_scene(scene, {256, 192});
}

Measured measure_cycle(double bars, std::uint64_t seed) {
  Random random(seed);
  return measure_scene(ring_of_bars(static_cast<int>(bars), double{random.uniform(0.0f, 6.28f)}),
                       [](const VisibilityScore& s) { return s.wrong_triangle; });
}

Measured measure_sliver_depth(double aspect, std::uint64_t seed) {
  Random random(seed);
  const double nearest = double{random.uniform(5.0f, 20.0f)};
  return measure_scene(slivers(aspect, nearest, nearest + double{random.uniform(20.0f, 60.0f)}),
                       [](const VisibilityScore& s) { return s.wrong_triangle + s.out_of_range; });
}

}  // namespace

std::vector<Sweep> visibility_sweeps() {
  constexpr std::string_view kDepthBits =
      "31 bits of depth err by up to 34 units: z^2 / (2^26 near) at a distance z";
  return {{"separation_at_10",
           Family::visibility,
           "two tilted planes at z = 10, in either order; near 0.1, far 1000",
           {"separation", ""},
           decades(0, -8),
           [](double separation, std::uint64_t seed) { return measure_separation(10, separation, seed); },
           kDepthBits},
          {"separation_at_100",
           Family::visibility,
           "two tilted planes at z = 100, in either order; near 0.1, far 1000",
           {"separation", ""},
           decades(1, -7),
           [](double separation, std::uint64_t seed) { return measure_separation(100, separation, seed); },
           kDepthBits},
          {"cycle",
           Family::visibility,
           "bars, each over the end of the previous one; three or more form a cycle",
           {"bars", ""},
           {1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24},
           measure_cycle},
          {"sliver_depth",
           Family::visibility,
           "slivers: visible triangles, and depths outside the triangle's own range",
           {"length over width", ""},
           decades(1, 5),
           measure_sliver_depth}};
}

}  // namespace edgewise::lab

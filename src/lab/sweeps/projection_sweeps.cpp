// Projection sweeps: the same sphere farther and farther from the origin of its mesh, and from the camera.
#include <algorithm>
#include <iterator>

#include "core/random.h"
#include "lab/projection/projection.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

namespace {

// Of ours and the exact ones, those of kShownBits.
const std::vector<ProjectionMethod>& swept_projections() {
  static const std::vector<ProjectionMethod> list = [] {
    std::vector<ProjectionMethod> all(projection_methods().begin(), projection_methods().end());
    std::erase_if(all, [](const ProjectionMethod& method) {
      return method.snap_bits && std::ranges::find(kShownBits, *method.snap_bits) == std::end(kShownBits);
    });
    return all;
  }();
  return list;
}

Measured measure_scene(Scene scene) {
  const ProjectionJudge judge(std::move(scene), {480, 270}, 1);
  return measured(swept_projections(), [&](const ProjectionMethod& method) {
    return Tally{judge.score(method).wrong, judge.crossings()};
  });
}

}  // namespace

std::vector<MethodInfo> swept_projection_methods() {
  return infos_of(swept_projections());
}

std::vector<Sweep> projection_sweeps() {
  constexpr std::string_view kRounding = "8 bits move a vertex by up to 1/512 px, and so do floats far away";
  return {{"far_from_origin",
           Family::projection,
           "a sphere whose vertices, and the camera, lie far from the mesh's own origin",
           {"distance on each axis", "radii"},
           powers_of_two(0, 16),
           [](double away, std::uint64_t seed) {
             Scene scene = sphere_far_from_origin(away);
             scene.camera.yaw += Random(seed).uniform(-0.05f, 0.05f);
             return measure_scene(std::move(scene));
           },
           kRounding},
          {"far_from_camera",
           Family::projection,
           "a sphere far from the camera, as large in the picture",
           {"distance", "radii"},
           powers_of_two(2, 20),
           [](double distance, std::uint64_t seed) {
             Scene scene = sphere_far_from_camera(distance);
             scene.instances.front().angle = Random(seed).uniform(0.0f, 6.28f);
             return measure_scene(std::move(scene));
           },
           kRounding}};
}

}  // namespace edgewise::lab

// Projection sweeps: the same sphere farther and farther from the origin of its mesh, and from the camera.
#include "lab/projection/projection.h"
#include "lab/sweeps/sweeps.h"

namespace edgewise::lab {

namespace {

Measured measure_scene(Scene scene, bool quick) {
  const auto methods = projection_methods();
  const ProjectionJudge judge(std::move(scene), quick ? Size{480, 270} : Size{1920, 1080}, 1);
  Measured result(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i)
    result.methods[i] = {judge.score(methods[i]).wrong, judge.crossings()};
  return result;
}

}  // namespace

std::vector<Sweep> projection_sweeps() {
  constexpr YAxis kWrongSamples{"wrong samples per 10^6 edge crossings", true, 1e6};
  return {{"far_from_origin",
           Family::projection,
           "a sphere whose vertices, and the camera, lie far from the mesh's own origin",
           {"distance on each axis", "radii", true},
           kWrongSamples,
           10,
           powers_of_two(0, 16),
           [](double away, bool quick, int) { return measure_scene(sphere_far_from_origin(away), quick); }},
          {"far_from_camera",
           Family::projection,
           "a sphere far from the camera, as large in the picture",
           {"distance", "radii", true},
           kWrongSamples,
           10,
           powers_of_two(2, 20),
           [](double distance, bool quick, int) {
             return measure_scene(sphere_far_from_camera(distance), quick);
           }}};
}

}  // namespace edgewise::lab

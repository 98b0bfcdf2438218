#include <utility>

#include "lab/coverage/coverage.h"
#include "lab/projection/truth.h"

namespace edgewise::lab {

CoverageScene coverage_scene(const Drawable& drawable, FrontendOptions options) {
  const auto* scene = std::get_if<Scene>(&drawable);
  if (scene == nullptr) return coverage_scene_of_floats(drawable, options);
  const Cull cull = std::exchange(options.cull, Cull::none);
  options.payload = Payload::id;
  CoverageScene result = coverage_scene_of_floats(drawable, options);
  result.truth = std::make_shared<SceneTruth>(*scene, result.size, cull);
  result.keep_if([&](std::size_t i) { return result.truth->facing(result.floats[i].payload) != 0; });
  for (const FloatTriangle& t : result.floats) result.sources.push_back(t.payload);
  return result;
}

}  // namespace edgewise::lab

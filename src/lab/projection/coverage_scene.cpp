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

std::vector<FloatTriangle> outlines_of(const SceneTruth& truth) {
  std::vector<FloatTriangle> outlines;
  for (std::uint32_t i = 0; i < truth.size(); ++i) {
    const auto apart = -1.0f - static_cast<float>(i);
    FloatTriangle& t = outlines.emplace_back(
        FloatTriangle{{{apart, apart, apart}, {apart, apart, apart}, {apart, apart, apart}}, i});
    const auto corners = truth.outline(i);
    for (std::size_t k = 0; k < 3 && corners.size() == 3; ++k) {
      t.at.x_px[k] = static_cast<float>(corners[k].x), t.at.y_px[k] = static_cast<float>(corners[k].y);
      t.at.z01[k] = static_cast<float>(corners[k].z);
    }
  }
  return outlines;
}

}  // namespace edgewise::lab

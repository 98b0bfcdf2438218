#include "lab/coverage/scene.h"

namespace edgewise::lab {

CoverageScene coverage_scene(const Drawable& drawable, FrontendOptions options) {
  const Cull cull = options.cull;
  options.cull = Cull::none;
  options.keep_unsnapped = true;
  Frontend frontend;
  const auto screen = frontend.run(drawable, options);
  CoverageScene scene{{options.width, options.height},
                      unsnapped(screen, frontend.unsnapped()),
                      {screen.begin(), screen.end()}};
  if (cull == Cull::none) return scene;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < screen.size(); ++i) {
    if (!keeps(cull, FloatTruth(scene.floats[i].at).facing())) continue;
    scene.floats[kept] = scene.floats[i];
    scene.snapped[kept++] = scene.snapped[i];
  }
  scene.floats.resize(kept);
  scene.snapped.resize(kept);
  return scene;
}

}  // namespace edgewise::lab

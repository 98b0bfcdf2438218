// The scenes on which the laboratory's methods are judged and timed. Each is built only when it is used.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "lab/clipping/clipping.h"
#include "lab/coverage/coverage.h"
#include "lab/facing/facing.h"
#include "lab/method.h"
#include "lab/projection/projection.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

using AnyScene = std::variant<CoverageScene, VisibilityScene, FacingScene, ClippingScene, ProjectionScene>;

struct LabScene {
  Family family;
  std::string name;
  bool smallest;  // a small scene that shows a single failure; only these get close-ups
  std::function<AnyScene()> make;
};

// Family by family. `quick`: smaller scenes. Backends get positions of so many subpixel bits.
std::vector<LabScene> lab_scenes(bool quick, int subpixel_bits = 8);

// A mesh or stream, and the size of its picture.
struct SizedDrawable {
  Drawable drawable;
  Size size;
};
// The user's own scene: one for coverage, and for a mesh one for visibility and one for projection.
LabScene own_coverage_scene(const std::string& name, std::function<SizedDrawable()> load,
                            int subpixel_bits = 8);
std::vector<LabScene> own_scenes(const std::string& name, bool stream, std::function<SizedDrawable()> load,
                                 int subpixel_bits = 8);

}  // namespace edgewise::lab

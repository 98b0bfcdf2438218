// The tutorials that this project grew from, as demonstrations: a scene, the steps that lead through it, and
// what to notice at each. All that is seen is done by the library and the laboratory, and by the keys that
// anybody has.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "viewer/session.h"

namespace edgewise::viewer {

struct Demo {
  std::string_view name;      // the key on the command line and in names of files
  std::string_view tutorial;  // whose it is
  std::string_view idea;      // one line
  Scene (*scene)();
  Cull cull;                        // to begin with
  std::span<const Step> steps;      // as a picture, what the last one leads to
  std::optional<glm::vec3> axis{};  // that objects turn about; none: the scene's own
};

std::span<const Demo> demos();

// Throws std::invalid_argument, with the nearest known name, for an unknown one.
const Demo& find_demo(std::string_view name);

// The session's beginning, before the first step.
Start start_of(const Demo& demo);

// The size that the scenes are arranged for.
inline constexpr app::Size kDemoSize{960, 540};

}  // namespace edgewise::viewer

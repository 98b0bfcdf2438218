// The tutorials that Edgewise grew from, as demos: a scene, steps of keys, and what to notice after each
// step. Demos use only the library, src/lab and the viewer's keys.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "viewer/session.h"

namespace edgewise::viewer {

struct Demo {
  std::string_view name;      // on the command line and in file names
  std::string_view tutorial;  // the tutorial's title
  std::string_view summary;   // one line
  Scene (*scene)();
  Cull cull;                        // at the start
  std::span<const Step> steps;      // a demo's picture shows the state after the last one
  std::optional<glm::vec3> axis{};  // rotation axis of the objects; none: the first object's
};

std::span<const Demo> demos();

// Throws std::invalid_argument with the nearest known name for an unknown name.
const Demo& find_demo(std::string_view name);

// The session's start, before the first step.
Start start_of(const Demo& demo);

// The picture size for which the scenes are composed.
inline constexpr tools::Size kDemoSize{960, 540};

}  // namespace edgewise::viewer

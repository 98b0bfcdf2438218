// The scenes of `edgewise accuracy`, by name; each is built only when it is judged.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "cli/accuracy/accuracy.h"
#include "lab/coverage/coverage.h"

namespace edgewise::tools {

using AnyScene = std::variant<lab::CoverageScene, lab::VisibilityScene, lab::FacingScene, lab::ClippingScene>;

struct AccuracyScene {
  Family family;
  std::string name, summary;
  bool timed;
  bool smallest;  // a small scene that shows a single failure; only these get close-ups
  double cost_s;  // estimate for the progress bar
  std::function<AnyScene()> make;
};

inline constexpr std::string_view kTurningCube = "turning-cube";
inline constexpr lab::Size kTurningCubeSize{640, 360};

// The scenes that the plan names, family by family, and whether it includes the rotating cube.
struct AccuracyScenes {
  std::vector<AccuracyScene> scenes;
  bool turning_cube = false;
};
AccuracyScenes scenes_of(const AccuracyPlan& plan);

}  // namespace edgewise::tools

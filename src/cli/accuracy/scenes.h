// The scenes that accuracy is measured on: by name, made when their turn comes.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "cli/accuracy/accuracy.h"
#include "lab/coverage/coverage.h"

namespace edgewise::app {

struct CoverageScene {
  lab::Size size;
  std::vector<lab::FloatTriangle> floats;
  std::vector<ScreenTriangle> snapped;

  lab::CoverageInput input() const { return {floats, snapped}; }
  lab::Window window() const { return {size.width, size.height}; }
};
using AnyScene = std::variant<CoverageScene, lab::VisibilityScene, lab::FacingScene, lab::ClippingScene>;

struct AccuracyScene {
  Family family;
  std::string name, idea;
  bool timed;
  bool smallest;  // one of those that show one failure each; pictures are made of these
  double cost_s;  // about, for the progress bar
  std::function<AnyScene()> make;
};

inline constexpr std::string_view kTurningCube = "turning-cube";
inline constexpr lab::Size kTurningCubeSize{640, 360};

// What the plan names, in a fixed order, and whether the turning cube is among it.
struct AccuracyScenes {
  std::vector<AccuracyScene> scenes;
  bool turning_cube = false;
};
AccuracyScenes scenes_of(const AccuracyPlan& plan);

// A front end's triangles before and after snapping. Back faces of meshes are dropped by the exact sign of
// their area before snapping, so that all methods get the same triangles.
CoverageScene coverage_scene(const Drawable& drawable, lab::Size size);

}  // namespace edgewise::app

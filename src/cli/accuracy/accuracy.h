// How wrong is each method, and how fast? Every method of every family on every scene, against the truth.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/accuracy/closeup.h"
#include "lab/clipping/clipping.h"
#include "lab/coverage/score.h"
#include "lab/coverage/visible.h"
#include "lab/facing/facing.h"
#include "lab/family.h"
#include "lab/visibility/visibility.h"

namespace edgewise::app {

using lab::Family;

struct AccuracyPlan {
  std::vector<std::string> scenes;   // names or paths; none: all that are built in
  std::vector<std::string> methods;  // none: all
  std::optional<Family> family;      // none: all
  bool quick = false;                // small sizes, few frames and repetitions
  bool fit = false;                  // see load_source
  bool speed = true;                 // whether to time methods on the scenes that are meant for it
  bool pictures = false;             // whether to keep close-ups of errors
  int threads = 1;                   // of the judging; what is timed has its own
  std::function<void(double, std::string_view)> on_progress;  // fraction done, scene
};

struct CoverageScores {
  lab::CoverageScore snapped, floats;  // against each truth
  lab::OwnerScore owners;
};
using Score = std::variant<CoverageScores, lab::VisibilityScores, lab::FacingScores, lab::ClippingScore>;

struct Speed {
  int threads;
  double median_ms, min_ms, max_ms;
  int repetitions;
};

struct MethodResult {
  std::string name;
  bool exact;
  Score score;
  std::vector<Speed> speed;  // only on scenes that are timed
};

struct SceneResult {
  Family family;
  std::string name, idea;
  bool smallest;  // see AccuracyScene
  int width, height;
  std::uint64_t triangles = 0;  // facing: polygons
  // Coverage: pairs of triangle and pixel; visibility and clipping: pixels; facing: faces that own a pixel.
  // All in truth; in that of the snapped positions where there are two, but facing's before snapping.
  std::uint64_t covered = 0;
  std::uint64_t crossings = 0;  // coverage only: edges with rows or columns of samples
  std::vector<MethodResult> methods;
  double seconds = 0;

  // What errors are counted by.
  std::uint64_t trials() const { return family == Family::coverage ? crossings : covered; }
};

struct PerFrame {
  std::uint64_t median = 0, worst = 0, total = 0;
};
struct CubeCounts {
  PerFrame gaps, double_hits, missing, extra;
};
struct CubeMethodResult {
  std::string name;
  bool exact;
  CubeCounts snapped, floats;  // against each truth
};
struct CubeResult {
  int frames, width, height;
  std::vector<CubeMethodResult> methods;
};

struct AccuracyReport {
  std::vector<SceneResult> scenes;
  std::optional<CubeResult> turning_cube;
  std::vector<Closeup> closeups;  // only if asked for

  bool ok() const;  // no method broke a promise that holds on every scene
};

// Throws std::invalid_argument for unknown names, and what load_source throws; both before work begins.
AccuracyReport measure_accuracy(const AccuracyPlan& plan);

}  // namespace edgewise::app

// Counts the errors of every method of every family on every scene against exact references.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/accuracy/closeup.h"
#include "lab/coverage/cracks.h"
#include "lab/coverage/visible.h"
#include "lab/projection/projection.h"
#include "lab/scenes.h"

namespace edgewise::tools {

using lab::Family;

struct AccuracyPlan {
  std::vector<std::string> scenes;   // names or paths; none: the built-in default scenes
  std::vector<std::string> methods;  // none: all
  std::optional<Family> family;      // none: all
  int subpixel_bits = 8;             // of the backends' positions
  bool quick = false;                // small sizes, few frames
  bool fit = false;                  // see load_source
  bool pictures = false;             // whether to keep close-ups of errors
  bool peers = false;                // other projects' rasterizers in place of the methods: `choice` only
  int threads = 1;                   // results don't depend on it
  std::function<void(double, std::string_view)> on_progress;  // fraction done, scene
};

// The numbers of samples in lab::Cracks. At a fold, too, two neighbours draw one sample.
struct CrackCounts {
  CrackCounts() = default;
  explicit CrackCounts(const lab::Cracks& cracks)
      : gaps(cracks.gaps.size()),
        double_hits(cracks.double_hits.size() + cracks.folds.size()),
        t_junctions(cracks.at_t_junctions()) {}
  std::uint64_t gaps = 0, double_hits = 0, t_junctions = 0;
};

struct CoverageScores {
  lab::CoverageScore snapped, source;  // against each reference: the snapped positions, and the source
  CrackCounts cracks;
  lab::VisibleTriangleScore visible;
};
using Score = std::variant<CoverageScores, lab::VisibilityScores, lab::FacingScores, lab::ClippingScore,
                           lab::ProjectionScore>;

struct MethodResult {
  std::string name;
  bool exact;
  Score score;
};
// Whether it broke a promise that holds on every scene.
bool broke_promise(const MethodResult& method);

// What no rate sums: small scenes that show one failure each; and of coverage, meshes, single triangles,
// which have an outline only, and scenes whose vertices all lie on the grid of 1/256 px, where ours round
// nothing.
enum class SceneKind { scenes, small, meshes, triangles, our_grid };
inline constexpr std::string_view kSceneKinds[] = {"scenes", "small scenes", "meshes", "single triangles",
                                                   "vertices on our grid"};

struct SceneResult {
  Family family;
  std::string name;
  SceneKind kind;
  std::uint64_t triangles = 0;  // facing: polygons
  // Coverage and projection: (triangle, pixel) pairs; visibility and clipping: pixels; facing: faces that
  // cover a sample. Counted by the exact reference: the snapped one where there are two, but for facing that
  // of the source.
  std::uint64_t covered = 0;
  std::uint64_t crossings = 0;         // coverage and projection: of edges with rows or columns of samples
  std::uint64_t shared_crossings = 0;  // coverage only: of edges that triangles share
  std::uint64_t slits = 0;             // coverage only: of the exact picture; see lab::VisibleTriangleScore
  float largest_side_px = 0;           // coverage only: of the triangles' bounding boxes
  std::vector<MethodResult> methods;

  // The denominator of error rates.
  std::uint64_t trials() const {
    return family == Family::coverage || family == Family::projection ? crossings : covered;
  }
};

// Of all frames; against the source, and `wrong_snapped` against the snapped positions.
struct CubeMethodResult {
  std::string name;
  bool exact;
  std::uint64_t gaps = 0, double_hits = 0, missing = 0, extra = 0, wrong_snapped = 0;
};
struct CubeResult {
  int frames, width, height;
  std::vector<CubeMethodResult> methods;
};

// See lab::PixelChanges.
struct MotionResult {
  std::string name;
  int frames;
  std::uint64_t changes;  // of pixels, by the exact reference before snapping
  std::vector<std::pair<std::string, std::uint64_t>> superfluous;  // of each method
};

// Of all frames of a lab::ChoiceScene: wrong pixels in the best and the worst one, and the sums.
struct ChoiceTotal {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max(), most = 0, wrong = 0, holes = 0;
};
struct ChoiceResult {
  std::string_view name, summary;
  lab::Size size;
  int frames;
  std::vector<std::pair<std::string, ChoiceTotal>> methods = {};
  std::optional<ChoiceTotal> float_projection = {};  // see lab::ChoiceJudge
};

struct AccuracyReport {
  std::vector<SceneResult> scenes;
  std::optional<CubeResult> turning_cube;
  std::vector<MotionResult> motions;  // with the turning cube
  std::vector<ChoiceResult> choices;
  std::vector<Closeup> closeups;  // empty unless the plan has `pictures`

  bool ok() const;  // whether every method kept the promises that hold on every scene
};

// Before any work, throws std::invalid_argument for unknown names or an empty selection, and what
// check_source throws; later, what load_source throws.
AccuracyReport measure_accuracy(const AccuracyPlan& plan);

// At most 80 columns. A table sums all scenes of a family, small test scenes apart. Where no error was
// observed, it prints the 95 % upper bound of the rate.
std::string accuracy_tables(const AccuracyReport& report);

nlohmann::json accuracy_json(const AccuracyReport& report, const AccuracyPlan& plan);

inline constexpr std::string_view kTurningCube = "turning-cube", kChoice = "choice";

// The scenes that the plan names, family by family, and whether it includes the rotating cube, and the frames
// of the chart for choosing a method.
struct AccuracyScenes {
  std::vector<lab::LabScene> scenes = {};
  bool turning_cube = false, choice = false;
};
AccuracyScenes scenes_of(const AccuracyPlan& plan);

}  // namespace edgewise::tools

// Which pipelines draw all frames right, and how many pixels each level of a stage draws wrong. A pixel is
// wrong if it shows another triangle than the exact picture of the scene's own vertices. A pipeline is right
// if no frame has more wrong pixels than are tolerated.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/coverage/coverage.h"
#include "lab/needs/pipeline.h"
#include "lab/needs/question.h"
#include "lab/needs/ranges.h"

namespace edgewise::lab {

// A stage's level while all other stages are exact.
struct Level {
  std::string name;
  std::uint64_t wrong_px = 0, worst_px = 0;  // of all frames, and of the worst one
  // Wrong pixels of triangles that their exact picture lacks, of all frames. The others are displaced: the
  // square of the farthest distance to a pixel at which the exact picture shows the same.
  std::uint64_t hidden_px = 0;
  std::int64_t farthest_squared_px = 0;
  // The first wrong pixel of the first frame that has more than are tolerated. None: the level is enough.
  std::optional<Witness> witness = {};

  bool enough() const { return !witness; }
  double farthest_px() const { return std::sqrt(static_cast<double>(farthest_squared_px)); }
};

struct Curve {
  Stage stage;
  std::vector<Level> levels;  // in the order of levels_of()
  std::string proof = {};     // of planes: why the first right level is enough. Empty: it was seen to be.
};

struct Minima {
  std::vector<Levels> right;  // each right pipeline of which no weaker one is right, in a fixed order
  std::size_t judged = 0;     // as many pipelines were compared
  // If none is right: the first of those whose worst frame has the fewest wrong pixels.
  Levels closest = {};
  std::uint64_t closest_px = 0;
};

class PipelineNeeds {
 public:
  explicit PipelineNeeds(std::uint64_t tolerance_px) : tolerance_px_(tolerance_px) {}

  // Draws the frame with each level of each stage, and keeps what other pipelines need to draw it. All frames
  // must be of one size and kind.
  void add(const StudiedFrame& frame, const CoverageScene& scene, const std::array<Reach, kViewPlanes>& reach,
           int threads);
  // Planes only of scenes, facing only if back faces are culled.
  std::vector<Curve> curves(const Ranges& ranges) const;
  // Judges all pipelines. Of planes, only levels that the ranges of the vertices do not prove to be more than
  // enough. `done` gets the share that is done.
  Minima minima(const Ranges& ranges, int threads, const std::function<void(double)>& done) const;

 private:
  struct Frame {
    std::uint64_t index;
    std::array<Reach, kViewPlanes> reach;
    PipelineFrame frame;
    std::vector<Run> right;  // the exact picture, row by row; its background, too

    std::vector<std::uint32_t> right_picture() const;
    // The same pipeline without levels of planes that draw the same triangles as stronger ones.
    Pipeline without_idle_planes(Pipeline pipeline) const;
  };
  class Places;
  class Search;

  void start(const StudiedFrame& frame);
  // `right`: the frame's exact picture.
  Level judge(const Frame& frame, std::span<const std::uint32_t> right, const Places& places,
              const Pipeline& pipeline, PipelineMemory& memory) const;
  Pipeline strongest(const Ranges& ranges) const;

  std::uint64_t tolerance_px_;
  std::vector<Stage> stages_;
  std::array<Curve, kStages> curves_;
  std::vector<Frame> frames_;
};

}  // namespace edgewise::lab

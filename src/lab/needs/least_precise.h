// The least precise of the pipelines that draw all frames right, and what each stage needs alone.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lab/needs/pipeline.h"
#include "lab/needs/question.h"
#include "lab/needs/ranges.h"

namespace edgewise::lab {

// From the exact pipeline on, stages are weakened in turn as far as they go, each by one level at a time. A
// step is taken if all frames stay right, and also with any two stages at more precise levels.
struct LeastPrecise {
  // By stage: the level, those above, and the next weaker one with its witness against that pipeline.
  std::vector<Question> stages;
  int orders = 0;                                          // of stages, all tried
  std::vector<std::map<std::string, std::string>> others;  // other orders' results: level by stage
};

class PipelineNeeds {
 public:
  // Draws the frame with each level of each stage while all other stages are exact, and keeps what other
  // pipelines need to draw it. All frames must be of one size and kind.
  void add(const StudiedFrame& frame, const std::array<Reach, kViewPlanes>& reach, int threads);
  // Each stage alone, the others being exact; and float depth buffers.
  std::vector<Question> alone(const Ranges& ranges) const;
  // Right pictures start from the front end's triangles. This judges them: in how many pixels of all frames
  // they differ by more than 1/64 px and depth ties from the scene's own vertices (lab/clipping/truth.h).
  // Snapping may turn slivers over.
  std::uint64_t unlike_scene() const { return unlike_scene_; }
  // Pictures are kept as asked for by the frames. `judged` gets the number of pipelines judged so far.
  LeastPrecise least_precise(const Ranges& ranges, int threads,
                             const std::function<void(std::size_t)>& judged) const;

 private:
  struct Frame {
    std::uint64_t index;
    bool keep_pictures;
    PipelineFrame frame;
    std::vector<std::pair<std::uint32_t, std::size_t>> right;  // runs of the right picture: id, end
  };
  class Search;

  void start(const StudiedFrame& frame);
  static bool is_right(const Frame& frame, const Pipeline& pipeline, PipelineMemory& memory);
  // Adds a witness if the picture is wrong. The answer must have none.
  static void compare(const Frame& frame, const Pipeline& pipeline, Answer& answer, PipelineMemory& memory);
  std::string proof(Stage stage, const Ranges& ranges, bool drop) const;

  std::vector<Stage> stages_;
  Pipeline exact_ = exact_pipeline();
  std::array<Question, kStages> alone_;
  Question float_depth_;
  std::uint64_t unlike_scene_ = 0;
  std::vector<Frame> frames_;
};

}  // namespace edgewise::lab

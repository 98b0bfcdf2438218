// What a scene needs: the least precise pipelines that draw the given frames right, the wrong pixels of each
// stage's levels, and what edges need. Each level that is not enough has a witness. Edges ignore triangle
// flags.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/coverage/coverage.h"
#include "lab/needs/pipeline_needs.h"
#include "lab/needs/question.h"
#include "lab/needs/ranges.h"

namespace edgewise::lab {

// How many subpixel bits a picture's edges need, and whether float edges are enough.
class CoverageNeeds {
 public:
  // `displacement`: how many pixels per 10^6 edge crossings may differ from the positions before snapping;
  // none: as many as with 8 subpixel bits.
  explicit CoverageNeeds(std::optional<double> displacement);
  void add(const StudiedFrame& frame, const CoverageScene& scene, int threads);
  std::vector<Question> questions() const;  // about cracks only if triangles share edges

 private:
  // A method of snapping or of float edges.
  struct Tried {
    Answer cracks, displaced;
    std::uint64_t wrong = 0;  // pixels that differ from the positions before snapping, in all frames
  };
  Question cracks(const char* name, const std::vector<Tried>& all) const;
  Question displaced() const;
  std::uint64_t allowed() const;

  std::optional<double> displacement_;
  std::vector<Tried> bits_, floats_;
  std::uint64_t crossings_ = 0, shared_crossings_ = 0;
};

struct NeedsOptions {
  std::uint64_t tolerance_px = 0;           // wrong pixels per frame of a right pipeline
  std::optional<double> displacement = {};  // see CoverageNeeds
  int threads = 1;
};

class Needs {
 public:
  explicit Needs(const NeedsOptions& options)
      : options_(options), pipelines_(options.tolerance_px), coverage_(options.displacement) {}

  // Studies the next frame. All frames must be of one size and of one kind, scenes or streams. Those in
  // double are rounded to floats.
  void add(const Drawable& drawable, FrontendOptions options);

  std::uint64_t frames() const { return frames_; }
  const Ranges& ranges() const { return ranges_; }
  // `done` gets the share that is done.
  Minima minima(const std::function<void(double)>& done = [](double) {}) const {
    return pipelines_.minima(ranges_, options_.threads, done);
  }
  std::vector<Curve> curves() const { return pipelines_.curves(ranges_); }
  // What edges need: their values, and no cracks.
  std::vector<Question> edges() const;

 private:
  NeedsOptions options_;
  Ranges ranges_;
  PipelineNeeds pipelines_;
  CoverageNeeds coverage_;
  std::uint64_t frames_ = 0;
};

}  // namespace edgewise::lab

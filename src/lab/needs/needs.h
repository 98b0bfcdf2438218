// What a scene needs: for each stage of a rasterizer the cheapest answer that draws the given frames without
// an error while all other stages are exact, and a witness against cheaper ones. Triangle flags are ignored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/needs/clipping.h"
#include "lab/needs/coverage.h"
#include "lab/needs/facing.h"
#include "lab/needs/question.h"
#include "lab/needs/visibility.h"

namespace edgewise::lab {

struct NeedsOptions {
  std::optional<double> displacement = {};  // see CoverageNeeds
  bool keep_pictures = false;               // see StudiedFrame
  bool ranges_only = false;                 // draws nothing; then only ranges() has a result
  int threads = 1;
};

class Needs {
 public:
  explicit Needs(const NeedsOptions& options) : options_(options), coverage_(options.displacement) {}

  // Studies the next frame. All frames must be of one size and of one kind, scenes or streams.
  void add(const Drawable& drawable, FrontendOptions options);

  std::uint64_t frames() const { return frames_; }
  const Ranges& ranges() const { return ranges_; }
  // Those about clipping and facing only for scenes with back faces culled.
  std::vector<Question> questions() const;

 private:
  NeedsOptions options_;
  Ranges ranges_;
  std::optional<ClippingNeeds> clipping_;
  std::optional<FacingNeeds> facing_;
  VisibilityNeeds visibility_;
  CoverageNeeds coverage_;
  std::uint64_t frames_ = 0;
};

}  // namespace edgewise::lab

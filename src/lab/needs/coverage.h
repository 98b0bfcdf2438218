// How many subpixel bits a picture's edges need, and whether float edges are enough.
#pragma once

#include <optional>
#include <vector>

#include "lab/coverage/scene.h"
#include "lab/needs/ranges.h"

namespace edgewise::lab {

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
  Question cracks() const;
  Question displaced() const;
  Question floats() const;
  std::uint64_t allowed() const;

  std::optional<double> displacement_;
  std::vector<Tried> bits_, floats_;
  std::uint64_t crossings_ = 0, shared_crossings_ = 0;
};

}  // namespace edgewise::lab

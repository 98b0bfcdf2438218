// What a scene needs: for each stage of a rasterizer the cheapest answer that draws the given frames without
// an error while all other stages are exact, and a witness against cheaper ones. Triangle flags are ignored.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lab/coverage/coverage.h"
#include "lab/needs/question.h"
#include "lab/needs/ranges.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

// What a scene needs at the planes of the view volume: nothing, dropping whole triangles, or clipping.
class ClippingNeeds {
 public:
  ClippingNeeds();
  // Draws pictures only where the ranges of the vertices leave a doubt. The frame must hold a scene.
  void add(const StudiedFrame& frame, const std::array<Reach, kViewPlanes>& reach);
  std::vector<Question> questions(const Ranges& ranges) const;

 private:
  std::array<Question, kViewPlanes> questions_;
};

// Whether back faces may be drawn, and which facing test is enough to drop them.
class FacingNeeds {
 public:
  FacingNeeds();
  // Frames must hold scenes whose back faces are culled.
  void add(const StudiedFrame& frame);
  std::vector<Question> questions() const { return {back_faces_, test_}; }

 private:
  Question back_faces_, test_;
};

// Whether drawing in order is enough or a depth buffer is needed, and with how many bits.
class VisibilityNeeds {
 public:
  VisibilityNeeds();
  // `scene` holds the triangles of the frame; payloads are ids.
  void add(const StudiedFrame& frame, const VisibilityScene& scene, int threads);
  std::vector<Question> questions() const { return {method_, bits_}; }

 private:
  Question method_, bits_;
};

// The triangles that the front end makes of a frame with these options. Streams have no camera. The result's
// planes are then at 1 and 2, and its distances 1 / (1 - z / 2), which give each vertex its depth z again.
VisibilityScene visibility_scene(const Drawable& drawable, FrontendOptions options);

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
  Question cracks() const;
  Question displaced() const;
  Question floats() const;
  std::uint64_t allowed() const;

  std::optional<double> displacement_;
  std::vector<Tried> bits_, floats_;
  std::uint64_t crossings_ = 0, shared_crossings_ = 0;
};

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

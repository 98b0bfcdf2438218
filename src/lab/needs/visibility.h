// Whether drawing in order is enough or a depth buffer is needed, and with how many bits.
#pragma once

#include "lab/needs/question.h"
#include "lab/visibility/visibility.h"

namespace edgewise::lab {

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

}  // namespace edgewise::lab

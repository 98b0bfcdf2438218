// What a scene needs at the planes of the view volume: nothing, dropping whole triangles, or clipping.
#pragma once

#include <array>

#include "lab/needs/ranges.h"

namespace edgewise::lab {

class ClippingNeeds {
 public:
  ClippingNeeds();
  // Draws pictures only where the ranges of the vertices leave a doubt. The frame must hold a scene.
  void add(const StudiedFrame& frame, const std::array<Reach, kViewPlanes>& reach);
  std::vector<Question> questions(const Ranges& ranges) const;

 private:
  std::array<Question, kViewPlanes> questions_;
};

}  // namespace edgewise::lab

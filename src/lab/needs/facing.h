// Whether back faces may be drawn, and which facing test is enough to drop them.
#pragma once

#include "lab/needs/question.h"

namespace edgewise::lab {

class FacingNeeds {
 public:
  FacingNeeds();
  // Frames must hold scenes whose back faces are culled.
  void add(const StudiedFrame& frame);
  std::vector<Question> questions() const { return {back_faces_, test_}; }

 private:
  Question back_faces_, test_;
};

}  // namespace edgewise::lab

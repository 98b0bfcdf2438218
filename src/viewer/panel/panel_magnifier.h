// The panel's magnifier: the pixels around the session's focus, and the triangles that reach it.
#pragma once

#include <array>
#include <vector>

#include "edgewise/image.h"
#include "viewer/annotations.h"
#include "viewer/session.h"

namespace edgewise::viewer {

class Magnifier {
 public:
  // Finds the triangles, of the active side where both are shown. Once per picture.
  void look(const Session& session);
  // What was laid out refers to images of this object until it is painted.
  void lay_out(const Session& session);

 private:
  std::size_t side_ = 0;
  std::vector<TriangleOfPixel> triangles_;
  std::array<Image, 2> zoomed_;
};

}  // namespace edgewise::viewer

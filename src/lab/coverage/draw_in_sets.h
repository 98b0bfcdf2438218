// Records the pixels of each triangle with code that draws whole frames: triangles are drawn in sets with
// disjoint bounding boxes.
#pragma once

#include <span>
#include <vector>

#include "edgewise/framebuffer.h"
#include "lab/cases/backend_comparison.h"
#include "lab/coverage/coverage.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

// Triangles relative to the window's corner, each with its index as payload. Throws std::invalid_argument for
// one that then lies beyond the guard band.
std::vector<ScreenTriangle> shifted(std::span<const ScreenTriangle> triangles, Window window);

// Calls draw(set, frame) for sets of triangles. It must draw all of a set, over a background of
// kNoTriangle, each with its index as payload and inside its box. Only the boxes of `boxes` count; they are
// relative to the window's corner.
template <typename Draw>
void draw_in_sets(std::span<const ScreenTriangle> boxes, Window window, std::vector<Run>& runs, Draw&& draw) {
  Framebuffer frame(window.width, window.height);
  for (const auto& set : disjoint_sets(boxes, window.width, window.height)) {
    draw(std::span(set), frame);
    for (int y = 0; y < window.height; ++y)
      append_runs({frame.payload_row(y), static_cast<std::size_t>(window.width)}, y + window.y0, window.x0,
                  runs);
  }
}

}  // namespace edgewise::lab

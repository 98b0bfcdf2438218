// Plain rasterizers of one thread that do no more than a scene needs.
#pragma once

#include <string>

#include "lab/visibility/visibility.h"

namespace edgewise::lab {

struct Pipeline {
  enum class Order { submission, mean, farthest, depth };
  int subpixel_bits;   // 0, 4, 8 or 16
  int edge_bits;       // 32 or 64, of integers that hold edge values
  Order order;         // mean, farthest: painter's algorithm
  int depth_bits = 0;  // Order::depth only: 16, 24 or 30

  std::string describe() const;  // "4 subpixel bits, 32-bit edges, no depth buffer"
};

// The next larger number of subpixel bits that a Pipeline has.
int pipeline_subpixel_bits(int fewest);

// Draws the scene's visible triangles. Throws std::invalid_argument for bits that a Pipeline does not have.
void draw(const Pipeline& pipeline, const VisibilityScene& scene, VisibilityFrame& frame);

}  // namespace edgewise::lab

// Plain rasterizers of one thread, for triangles that the front end has clipped and culled.
#pragma once

#include <string>

#include "lab/visibility/visibility.h"

namespace edgewise::lab {

struct Pipeline {
  enum class Order { submission, mean, farthest, depth };
  int subpixel_bits;   // of kPipelineSubpixelBits
  int edge_bits;       // 32 or 64, of integers that hold edge values
  Order order;         // mean, farthest: painter's algorithm
  int depth_bits = 0;  // Order::depth only: of kPipelineDepthBits

  bool operator==(const Pipeline&) const = default;
  std::string describe() const;  // "4 subpixel bits, 32-bit edges, submission order"
};

// The bits that a Pipeline may have.
inline constexpr int kPipelineSubpixelBits[] = {0, 4, 8, 16}, kPipelineDepthBits[] = {16, 24, 30};

// Draws the scene's visible triangles. Throws std::invalid_argument for bits that a Pipeline does not have.
void draw(const Pipeline& pipeline, const VisibilityScene& scene, VisibilityFrame& frame);

}  // namespace edgewise::lab

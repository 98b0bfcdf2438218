// Moves streams to the right and down by whole pixels, and moves their pictures back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "edgewise/contract.h"
#include "edgewise/framebuffer.h"
#include "edgewise/scene.h"

namespace edgewise::testing {

struct Move {
  int x, y;  // px, not negative
};

inline std::string text(Move move) {
  return "moved by " + std::to_string(move.x) + ", " + std::to_string(move.y) + " px";
}

// A stream and its moved copy, whose image is larger by the move. Triangles that would leave the guard band
// are removed from both.
inline std::pair<TriangleStream, TriangleStream> before_and_after(const TriangleStream& stream, Move move) {
  std::pair<TriangleStream, TriangleStream> both{{stream.width, stream.height, {}},
                                                 {stream.width + move.x, stream.height + move.y, {}}};
  constexpr float kGuardPx = contract::kMaxImageSide;
  for (const StreamTriangle& t : stream.triangles) {
    StreamTriangle moved = t;
    for (glm::vec3& v : moved.vertex) v += glm::vec3(move.x, move.y, 0);
    if (std::any_of(moved.vertex, moved.vertex + 3,
                    [](const glm::vec3& v) { return v.x > kGuardPx || v.y > kGuardPx; }))
      continue;
    both.first.triangles.push_back(t);
    both.second.triangles.push_back(moved);
  }
  return both;
}

// Copies the part of a moved picture that was in view before the move. Rows begin every `stride` values.
inline void copy_moved_back(const std::uint32_t* from, std::ptrdiff_t stride, Move move, int width,
                            int height, std::uint32_t* to, std::ptrdiff_t to_stride) {
  for (int y = 0; y < height; ++y)
    std::copy_n(from + (y + move.y) * stride + move.x, width, to + y * to_stride);
}

inline Framebuffer moved_back(const Framebuffer& frame, Move move) {
  Framebuffer part(frame.width() - move.x, frame.height() - move.y);
  const FrameView view = part.view();
  copy_moved_back(frame.depth_row(0), frame.stride(), move, view.width, view.height, view.depth, view.stride);
  copy_moved_back(frame.payload_row(0), frame.stride(), move, view.width, view.height, view.payload,
                  view.stride);
  return part;
}

// The same for counts, row by row, of an image `width` px wide.
inline std::vector<std::uint32_t> moved_back(const std::vector<std::uint32_t>& counts, int width, Move move) {
  const int part_width = width - move.x, height = static_cast<int>(counts.size()) / width - move.y;
  std::vector<std::uint32_t> part(static_cast<std::size_t>(part_width) * static_cast<std::size_t>(height));
  copy_moved_back(counts.data(), width, move, part_width, height, part.data(), part_width);
  return part;
}

}  // namespace edgewise::testing

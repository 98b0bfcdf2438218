// The painter's algorithm (Newell, Newell and Sancha, 1972, without their splitting): sort, then overwrite.
#pragma once

#include <algorithm>
#include <numeric>

#include "lab/visibility_methods/depth_buffer.h"

namespace edgewise::lab {

inline void paint(const VisibilityScene& scene, VisibilityFrame& frame, std::uint32_t id) {
  for_each_span(scene.triangles[id].screen, scene, [&](int y, int begin, int end) {
    const auto row = frame.owner.begin() + std::ptrdiff_t{y} * scene.width;
    std::fill(row + begin, row + end, id);
  });
}

inline void clear_owners(const VisibilityScene& scene, VisibilityFrame& frame) {
  frame.owner.assign(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height), kNobody);
}

// Farthest first by key(triangle); equal keys in submission order.
template <typename Key>
void draw_painter(const VisibilityScene& scene, VisibilityFrame& frame, Key&& key) {
  clear_owners(scene, frame);
  frame.order.resize(scene.triangles.size());
  std::iota(frame.order.begin(), frame.order.end(), 0u);
  std::stable_sort(frame.order.begin(), frame.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key(scene.triangles[a]) > key(scene.triangles[b]);
  });
  for (const std::uint32_t id : frame.order) paint(scene, frame, id);
}

}  // namespace edgewise::lab

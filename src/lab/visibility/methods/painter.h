// The painter's algorithm (Newell, Newell and Sancha, 1972, without their splitting): sort, then overwrite.
#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "lab/visibility/methods/depth_buffer.h"

namespace edgewise::lab {

inline void paint(const VisibilityScene& scene, VisibilityFrame& frame, std::uint32_t id) {
  for_each_span(scene.triangles[id].screen, scene.width, scene.height, [&](int y, int begin, int end) {
    const auto row = frame.visible.begin() + std::ptrdiff_t{y} * scene.width;
    std::fill(row + begin, row + end, id);
  });
}

inline void clear_visible(const VisibilityScene& scene, VisibilityFrame& frame) {
  frame.visible.assign(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height),
                       kNoTriangle);
}

// Calls add(z) for the distance of each vertex of a face.
template <typename Add>
void for_each_distance(const VisibilityScene& scene, const VisibilityFace& face, Add&& add) {
  const VisibilityTriangle* const fan = scene.triangles.data() + face.first;
  add(fan[0].view_z[0]);
  add(fan[0].view_z[1]);
  for (std::uint32_t i = 0; i < face.count; ++i) add(fan[i].view_z[2]);
}

// The keys of the usual sorts.
inline double mean_distance(const VisibilityScene& scene, const VisibilityFace& face) {
  double sum = 0;
  for_each_distance(scene, face, [&](double z) { sum += z; });
  return sum / (face.count + 2);
}
inline double farthest_distance(const VisibilityScene& scene, const VisibilityFace& face) {
  double farthest = 0;
  for_each_distance(scene, face, [&](double z) { farthest = std::max(farthest, z); });
  return farthest;
}

// Sorts faces by descending key(scene, face), equal keys in submission order, into frame.order.
template <typename Key>
void sort_faces(const VisibilityScene& scene, VisibilityFrame& frame, Key&& key) {
  frame.key.resize(scene.faces.size());
  std::transform(scene.faces.begin(), scene.faces.end(), frame.key.begin(),
                 [&](const VisibilityFace& face) { return key(scene, face); });
  frame.order.resize(scene.faces.size());
  std::iota(frame.order.begin(), frame.order.end(), 0u);
  std::stable_sort(frame.order.begin(), frame.order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return frame.key[a] > frame.key[b]; });
}

// Calls draw(triangle) for all triangles of the sorted faces.
template <typename Draw>
void for_each_sorted(const VisibilityScene& scene, const VisibilityFrame& frame, Draw&& draw) {
  for (const std::uint32_t id : frame.order) {
    const VisibilityFace face = scene.faces[id];
    for (std::uint32_t i = 0; i < face.count; ++i) draw(face.first + i);
  }
}

template <typename Key>
void draw_painter(const VisibilityScene& scene, VisibilityFrame& frame, Key&& key) {
  clear_visible(scene, frame);
  sort_faces(scene, frame, key);
  for_each_sorted(scene, frame, [&](std::uint32_t id) { paint(scene, frame, id); });
}

inline std::pair<double, double> depth_range(const VisibilityScene& scene, std::uint32_t triangle) {
  const auto after =
      std::upper_bound(scene.faces.begin(), scene.faces.end(), triangle,
                       [](std::uint32_t id, const VisibilityFace& face) { return id < face.first; });
  std::pair range{scene.far_z, scene.near_z};
  for_each_distance(scene, *std::prev(after), [&](double z) {
    range = {std::min(range.first, z), std::max(range.second, z)};
  });
  return range;
}

// The painters' promise: of two faces with disjoint depth ranges, the nearer one is painted later.
inline bool ranges_overlap(const VisibilityScene& scene, std::uint32_t drawn, std::uint32_t truth) {
  const auto a = depth_range(scene, drawn), b = depth_range(scene, truth);
  return a.first <= b.second && b.first <= a.second;
}

}  // namespace edgewise::lab

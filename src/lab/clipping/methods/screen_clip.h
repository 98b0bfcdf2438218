// Sutherland and Hodgman against the four edges of the screen, after near, far and projection.
#pragma once

#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

// Vertex: whatever is interpolated linearly on the screen, with x_px and y_px. project(clip_vertex) makes
// one, lerp(inside, outside, t) cuts, and finish(vertex) says what is drawn.
template <typename Project, typename Lerp, typename Finish>
void draw_screen_clipped(const ClippingScene& scene, ClippingFrame& frame, Project&& project, Lerp&& lerp,
                         Finish&& finish) {
  using Vertex = decltype(project(ClipVertex{}));
  const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
  draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
    const auto sides = sides_of(triangle, scene.size);
    if (!sides) return;
    const auto in_front = frame.clipper.clip(triangle, *sides & (kNear | kFar));
    Vertex a[9], b[9];
    std::size_t count = in_front.size();
    std::transform(in_front.begin(), in_front.end(), a, project);
    const auto against = [&](const Vertex* from, Vertex* to, auto&& distance) {
      count = cut(std::span<const Vertex>(from, count), to, distance, lerp);
    };
    against(a, b, [](const Vertex& v) { return v.x_px; });
    against(b, a, [&](const Vertex& v) { return width - v.x_px; });
    against(a, b, [](const Vertex& v) { return v.y_px; });
    against(b, a, [&](const Vertex& v) { return height - v.y_px; });
    Projected polygon[9];
    std::transform(a, a + count, polygon, finish);
    emit(std::span<const Projected>(polygon, count), payload, scene.cull_back, frame);
  });
}

}  // namespace edgewise::lab

// Sutherland and Hodgman's clipping at the screen's four edges, after near and far clipping and projection.
#pragma once

#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

// Vertex holds x_px, y_px and the other values that are interpolated linearly on the screen.
// project(clip_vertex) makes one, lerp(inside, outside, t) interpolates, and finish(vertex) converts it to
// Projected.
template <typename Project, typename Lerp, typename Finish>
void draw_screen_clipped(const ClippingScene& scene, ClippingFrame& frame, Project&& project, Lerp&& lerp,
                         Finish&& finish) {
  using Vertex = decltype(project(ClipVertex{}));
  const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
  draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
    const auto sides = sides_of(triangle, frame.view);
    if (!sides) return;
    const auto in_front = frame.clipper.clip(triangle, *sides & (kNear | kFar), frame.view);
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

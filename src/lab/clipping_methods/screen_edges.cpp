// Sutherland and Hodgman against the four edges of the screen, after projection: the new vertices are snapped
// again, and so move the edges they lie on.
#include "lab/clipping_methods/pipeline.h"

namespace edgewise::lab {

extern const ClippingMethod clipping_screen_edges;
const ClippingMethod clipping_screen_edges{
    {"screen_edges", "near and far planes, then the screen's four edges after projection", "p5.js engine",
     "every difference lies within 1/64 px of where it would be none, but edges move as they leave the "
     "screen",
     false},
    [](const ClippingScene& scene, ClippingFrame& frame) {
      const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
      const auto lerp = [](const Projected& a, const Projected& b, float t) {
        return Projected{a.x_px + t * (b.x_px - a.x_px), a.y_px + t * (b.y_px - a.y_px),
                         a.z01 + t * (b.z01 - a.z01)};
      };
      draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
        const auto sides = sides_of(triangle, scene.size);
        if (!sides) return;
        const auto in_front = frame.clipper.clip(triangle, *sides & (kNear | kFar));
        Projected a[9], b[9];
        std::size_t count = in_front.size();
        std::transform(in_front.begin(), in_front.end(), a, divide);
        const auto polygon = [&](const Projected* p) { return std::span<const Projected>(p, count); };
        count = cut(
            polygon(a), b, [](const Projected& p) { return p.x_px; }, lerp);
        count = cut(
            polygon(b), a, [&](const Projected& p) { return width - p.x_px; }, lerp);
        count = cut(
            polygon(a), b, [](const Projected& p) { return p.y_px; }, lerp);
        count = cut(
            polygon(b), a, [&](const Projected& p) { return height - p.y_px; }, lerp);
        emit(polygon(a), payload, scene.cull_back, frame);
      });
    },
    0};

}  // namespace edgewise::lab

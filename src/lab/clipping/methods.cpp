// The table of clipping methods: one entry each, and what they compute beside pipeline.h.
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "core/trigonometry.h"
#include "lab/clipping/clipping.h"
#include "lab/clipping/pipeline.h"

namespace edgewise::lab {

namespace {

// Sutherland and Hodgman's clipping at the screen's four edges, after near and far clipping and projection.
//
// project(clip_vertex) makes a vertex whose values are interpolated linearly on the screen. Its z01 may hold
// another value, from which finish(vertex) then makes the depth.
template <typename Project, typename Finish>
void draw_screen_clipped(const ClippingScene& scene, ClippingFrame& frame, Project&& project,
                         Finish&& finish) {
  const auto between = [](const Projected& a, const Projected& b, float t) {
    return Projected{a.x_px + t * (b.x_px - a.x_px), a.y_px + t * (b.y_px - a.y_px),
                     a.z01 + t * (b.z01 - a.z01)};
  };
  const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
  draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
    const auto sides = sides_of(triangle, frame.view);
    if (!sides) return;
    const auto in_front = frame.clipper.clip(triangle, *sides & (kNear | kFar), frame.view);
    Projected a[9], b[9];
    std::size_t count = in_front.size();
    std::transform(in_front.begin(), in_front.end(), a, project);
    const auto against = [&](const Projected* from, Projected* to, auto&& distance) {
      count = cut(std::span<const Projected>(from, count), to, distance, between);
    };
    against(a, b, [](const Projected& v) { return v.x_px; });
    against(b, a, [&](const Projected& v) { return width - v.x_px; });
    against(a, b, [](const Projected& v) { return v.y_px; });
    against(b, a, [&](const Projected& v) { return height - v.y_px; });
    std::transform(a, a + count, b, finish);
    emit(std::span<const Projected>(b, count), payload, scene.cull_back, frame);
  });
}

// Clipping as most renderers do it: one 4 x 4 matrix of floats maps positions to clip space, where a vertex
// is inside for 0 <= z <= w. Far from the origin, the sums of its large products lose what distinguishes near
// vertices. And z - near and w - z are small differences of large numbers wherever the camera stands.
//
// `origin` is subtracted from the positions, in float, and from the camera.
void draw_by_matrix(const ClippingScene& scene, ClippingFrame& frame, glm::vec3 origin) {
  const Camera& camera = scene.scene.camera;
  const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
  const float tan = tangent(camera.fov_y / 2), near_z = camera.near_z, far_z = camera.far_z;
  glm::mat4 matrix(0.0f);
  matrix[0].x = 1 / (width / height * tan);
  matrix[1].y = 1 / tan;
  matrix[2] = {0, 0, far_z / (near_z - far_z), -1};
  matrix[3].z = far_z * near_z / (near_z - far_z);
  matrix *= glm::mat4(rotation({1, 0, 0}, -double{camera.pitch}));
  matrix *= glm::mat4(rotation({0, 1, 0}, -double{camera.yaw}));
  matrix = glm::translate(matrix, -glm::vec3(camera.position - glm::dvec3(origin)));
  // z is that of clip space here.
  const auto to_clip = [&](glm::vec3 position) {
    const glm::vec4 v = matrix * glm::vec4(position - origin, 1.0f);
    const float x = 0.5f * width * (v.w + v.x), y = 0.5f * height * (v.w - v.y);
    return ClipVertex{double{x}, double{y}, double{v.z}, double{v.w}};
  };
  draw_transformed(scene, frame, to_clip, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
    ClipVertex in_front[4], between[5];
    const auto count = cut<ClipVertex>(
        triangle, in_front, [](const ClipVertex& v) { return v.z; }, lerp);
    const auto kept = cut(
        std::span<const ClipVertex>(in_front, count), between, [](const ClipVertex& v) { return v.w - v.z; },
        lerp);
    for (std::size_t i = 2; i < kept; ++i) {
      const auto polygon = frame.clipper.clip({between[0], between[i - 1], between[i]}, kGuard, frame.view);
      Projected projected[Clipper::kMaxVertices];
      std::transform(polygon.begin(), polygon.end(), projected, [&](const ClipVertex& v) {
        const Projected p = divide(v, frame.view);
        return Projected{p.x_px, p.y_px, static_cast<float>(v.z) / static_cast<float>(v.w)};
      });
      emit(std::span<const Projected>(projected, polygon.size()), payload, scene.cull_back, frame);
    }
  });
}

const std::array<ClippingMethod, 8> kMethods{{
    // The backend restricts triangles to the image.
    {{"near_guard", "ours: near and far by view distance, guard band; in double", "frontend/clip.h",
      "differences within 1/64 px, if no edge across the screen has both ends over 2^40 px out; visible "
      "triangles right if depths, from 0 to 1, are over 2^-22 apart: z^2 / (2^22 near) at a distance z",
      true},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       FrontendOptions options;
       options.width = scene.size.width;
       options.height = scene.size.height;
       options.cull = scene.cull_back ? Cull::back : Cull::none;
       options.payload = Payload::id;
       frame.backend->draw(frame.frontend.run(scene.scene, options), frame.picture.view(), {kNoTriangle});
     },
     0,
     kDoubleReachPx},
    // At 0.01 for a near plane of 0.1. Points between have depths below 0, which are clamped here; in other
    // programs they wrap.
    {{"near_too_near", "near plane clipped at 0.01 under a projection whose near is 0.1",
      "a tutorial's mismatch of constants", "right where nothing is nearer than the near plane", false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       const float clip_w = scene.scene.camera.near_z * 0.1f;
       draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
         ClipVertex polygon[4];
         const auto count = cut<ClipVertex>(
             triangle, polygon, [&](const ClipVertex& v) { return v.w - clip_w; }, lerp);
         for (std::size_t i = 2; i < count; ++i) {
           const ClipVertex piece[3] = {polygon[0], polygon[i - 1], polygon[i]};
           emit(frame.clipper.clip(piece, kFar | kGuard, frame.view), payload, scene.cull_back, frame);
         }
       });
     },
     kNear,
     kReachPx},
    // The new vertices are snapped, which moves the edges on which they lie.
    {{"screen_edges", "near and far planes, then the screen's four edges after projection", "p5.js engine",
      "as near_guard, up to 2^17 px instead of 2^40; edges clipped at the screen may move by 1/256 px, which "
      "changes long runs of pixels if they are nearly horizontal",
      false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       const auto project = [&](const ClipVertex& v) { return divide(v, frame.view); };
       draw_screen_clipped(scene, frame, project, [](const Projected& p) { return p; });
     },
     0,
     kReachPx / 2},
    // On the screen 1 / w is linear and w is not, so a new vertex gets a wrong w. The same happens to any
    // other attribute that was not divided by w.
    {{"screen_linear", "the same, with w interpolated linearly where an edge is cut",
      "what the p5.js engine's clipping does to any attribute",
      "as screen_edges where nothing is cut; else distances from w0 to w1 come out too far by up to "
      "(sqrt w1 - sqrt w0)^2",
      false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       const float near_z = scene.scene.camera.near_z, far_z = scene.scene.camera.far_z;
       const float depth_scale = far_z / (far_z - near_z);
       const auto project = [&](const ClipVertex& v) {
         const Projected p = divide(v, frame.view);
         return Projected{p.x_px, p.y_px, static_cast<float>(v.w)};
       };
       draw_screen_clipped(scene, frame, project, [&](const Projected& at_w) {
         return Projected{at_w.x_px, at_w.y_px, depth_scale * (1.0f - near_z / at_w.z01)};
       });
     },
     kLeft | kRight | kTop | kBottom,
     kReachPx / 2},
    {{"matrix_relative", "the same, after subtracting the camera from positions in float",
      "\"camera-relative rendering\" of engines with large worlds",
      "as near_guard, up to 2^17 px instead of 2^40; planes less than a factor of 2^16 apart, which cut "
      "nothing",
      false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       draw_by_matrix(scene, frame, glm::vec3(scene.scene.camera.position));
     },
     kNear | kFar,
     kReachPx / 2,
     true,
     1 << 16},
    {{"matrix_float", "one 4×4 matrix of floats; near and far by 0 ≤ z ≤ w", "OpenGL, Direct3D, most engines",
      "as near_guard, up to 2^17 px instead of 2^40; camera at the origin; planes less than a factor of 2^16 "
      "apart, which cut nothing",
      false},
     [](const ClippingScene& scene, ClippingFrame& frame) { draw_by_matrix(scene, frame, glm::vec3(0.0f)); },
     kNear | kFar,
     kReachPx / 2,
     false,
     1 << 16},
    // Also discards triangles that reach behind the camera.
    {{"discard_behind", "discards triangles that have a vertex before the near plane", "many small engines",
      "right where no vertex is nearer than the near plane", false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
         const auto sides = sides_of(triangle, frame.view);
         if (!sides || (*sides & kNear) != 0) return;
         emit(frame.clipper.clip(triangle, *sides & (kFar | kGuard), frame.view), payload, scene.cull_back,
              frame);
       });
     },
     kNear,
     kReachPx},
    {{"none", "no clipping: divides by w even if w ≤ 0", "the trainer's first steps",
      "right where every vertex lies between near and far and within the guard band", false},
     [](const ClippingScene& scene, ClippingFrame& frame) {
       draw_clipped(scene, frame, [&](const ClipVertex(&triangle)[3], std::uint32_t payload) {
         emit(std::span<const ClipVertex>(triangle), payload, scene.cull_back, frame);
       });
     },
     kNear | kFar | kGuard,
     kReachPx},
}};

}  // namespace

std::span<const ClippingMethod> clipping_methods() {
  return kMethods;
}

}  // namespace edgewise::lab

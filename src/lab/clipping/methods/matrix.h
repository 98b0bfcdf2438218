// Clipping as most renderers do it: one 4 x 4 matrix of floats maps positions to clip space, where a vertex
// is inside for 0 <= z <= w. Far from the origin, the sums of its large products lose what distinguishes near
// vertices. And z - near and w - z are small differences of large numbers wherever the camera stands.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "lab/clipping/methods/pipeline.h"

namespace edgewise::lab {

// `origin` is subtracted from the positions, in float, and from the camera.
inline void draw_by_matrix(const ClippingScene& scene, ClippingFrame& frame, glm::vec3 origin) {
  const Camera& camera = scene.scene.camera;
  const auto width = static_cast<float>(scene.size.width), height = static_cast<float>(scene.size.height);
  glm::mat4 matrix = glm::perspectiveRH_ZO(camera.fov_y, width / height, camera.near_z, camera.far_z);
  matrix = glm::rotate(matrix, -camera.pitch, glm::vec3(1, 0, 0));
  matrix = glm::rotate(matrix, -camera.yaw, glm::vec3(0, 1, 0));
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

}  // namespace edgewise::lab

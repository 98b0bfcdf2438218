// What the facing methods share: projection and normals in float, and the loop over faces.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "lab/facing/facing.h"

namespace edgewise::lab {

// is_front(a, b, c) judges the first three vertices.
template <typename IsFront>
void classify_each(const FacingScene& scene, std::span<std::uint8_t> front, IsFront&& is_front) {
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const glm::vec3* v = scene.positions.data() + scene.faces[i].first;
    front[i] = is_front(v[0], v[1], v[2]) ? 1 : 0;
  }
}

class FloatProjector {
 public:
  explicit FloatProjector(const FacingView& view)
      : view_(view),
        centre_px_(static_cast<float>(view.size.width) * 0.5f, static_cast<float>(view.size.height) * 0.5f) {}
  glm::vec2 operator()(glm::vec3 p) const {
    const glm::vec3 ray = p - view_.eye;
    const float scale = view_.perspective ? view_.focal_px / glm::dot(view_.forward, ray) : view_.focal_px;
    return centre_px_ + scale * glm::vec2(glm::dot(view_.right, ray), glm::dot(view_.down, ray));
  }

 private:
  FacingView view_;
  glm::vec2 centre_px_;
};

// Outwards, of a face whose vertices are clockwise from outside.
inline glm::vec3 normal_of(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  return glm::cross(c - a, b - a);
}

// Rounding can turn the sign of a normal times a ray only where the face is that near to being seen edge-on.
inline double ray_rounding(const FaceFacts& face) {
  return 32 * 0x1p-24 * face.magnification;
}

// The methods that multiply a normal by its own ray are right in real arithmetic under perspective. Under an
// orthographic camera the eye has no place, and they err by the tilt.
inline bool ray_may_err(const FaceFacts& face, const FacingView& view) {
  return face.sine <= ray_rounding(face) + (view.perspective ? 0.0 : face.tilt_sine);
}

}  // namespace edgewise::lab

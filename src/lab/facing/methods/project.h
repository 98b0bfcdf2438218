// Shared by the facing methods: projection in float, and the loop over faces.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "lab/facing/facing.h"

namespace edgewise::lab {

// is_front(normal, v) tests a face by its normal or by its first three vertices.
template <typename IsFront>
void classify_each(const FacingScene& scene, std::span<std::uint8_t> front, IsFront&& is_front) {
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    front[i] = is_front(face.normal, scene.positions.data() + face.first) ? 1 : 0;
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

// Rounding can change the sign of the dot product of normal and ray only if FaceFacts::sine is at most this.
inline double ray_rounding(const FaceFacts& face) {
  return 32 * 0x1p-24 * face.magnification;
}

// For methods that use a ray of the face itself: they are exact in real arithmetic under perspective. Under
// an orthographic camera all rays are parallel, so they err by the tilt.
inline bool ray_may_err(const FaceFacts& face, const FacingView& view) {
  return face.sine <= ray_rounding(face) + (view.perspective ? 0.0 : face.tilt_sine);
}

}  // namespace edgewise::lab

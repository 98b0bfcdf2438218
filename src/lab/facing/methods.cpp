// The table of facing methods: one entry each.
#include <array>

#include "edgewise/contract.h"
#include "frontend/fixed.h"
#include "lab/facing/facing.h"

namespace edgewise::lab {

namespace {

// is_front(normal, v) tests a face by its normal or by its first three vertices.
template <typename IsFront>
void classify_each(const FacingScene& scene, std::span<std::uint8_t> front, IsFront&& is_front) {
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    front[i] = is_front(face.normal, scene.positions.data() + face.first) ? 1 : 0;
  }
}

// Rounding can change the sign of the dot product of normal and ray only if FaceFacts::sine is at most this.
double ray_rounding(const FaceFacts& face) {
  return 32 * 0x1p-24 * face.magnification;
}

// For methods that use a ray of the face itself: they are exact in real arithmetic under perspective. Under
// an orthographic camera all rays are parallel, so they err by the tilt.
bool ray_may_err(const FaceFacts& face, const FacingView& view) {
  return face.sine <= ray_rounding(face) + (view.perspective ? 0.0 : face.tilt_sine);
}

const std::array<FacingMethod, 7> kMethods{{
    {{"snapped_area", "ours: sign of the area of the snapped vertices", "edgewise/contract.h, rule 2",
      "wrong only about faces that are less than 1/128 px wide on the screen, which it draws as they are "
      "snapped",
      true},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       const FloatProjector project(scene.view);
       classify_each(scene, front, [&](glm::vec3, const glm::vec3* v) {
         ScreenTriangle t{};
         for (int i = 0; i < 3; ++i) {
           const glm::vec2 p = project(v[i]);
           t.x_q15[i] = snap(p.x);
           t.y_q15[i] = snap(p.y);
         }
         return contract::signed_area(t) > 0;
       });
     },
     // Snapping moves a vertex, and the side opposite to it, by at most sqrt(2) / 512 px each.
     [](const FaceFacts& face, const FacingView&) {
       return face.width_px <= 1.0 / 128 + 4 * face.rounding_px;
     }},
    {{"float_area", "sign of the area of the projected vertices in float", "most software renderers",
      "wrong only about faces narrower on the screen than the rounding of a projected vertex", false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       const FloatProjector project(scene.view);
       classify_each(scene, front, [&](glm::vec3, const glm::vec3* v) {
         const glm::vec2 p = project(v[0]), q = project(v[1]) - p, r = project(v[2]) - p;
         return q.x * r.y - q.y * r.x > 0.0f;
       });
     },
     [](const FaceFacts& face, const FacingView&) { return face.width_px <= 8 * face.rounding_px; }},
    // Needs no projection.
    {{"normal_dot_eye", "world-space normal times the ray to a vertex, <= 0", "REALbasic engine",
      "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
      false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
         return glm::dot(normal, v[0] - eye) <= 0.0f;
       });
     },
     ray_may_err,
     true},
    {{"normal_dot_centroid", "normal times the ray to the first three vertices' mean",
      "a mean-direction variant",
      "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
      false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
         return glm::dot(normal, (v[0] + v[1] + v[2]) * (1.0f / 3.0f) - eye) < 0.0f;
       });
     },
     ray_may_err,
     true},
    {{"normal_dot_mean_ray", "normal times the mean of the unit rays to the vertices",
      "a mean-direction variant",
      "perspective: wrong only where a face is edge-on up to rounding; orthographic: wrong by the ray's tilt",
      false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       classify_each(scene, front, [eye = scene.view.eye](glm::vec3 normal, const glm::vec3* v) {
         const glm::vec3 rays =
             glm::normalize(v[0] - eye) + glm::normalize(v[1] - eye) + glm::normalize(v[2] - eye);
         return glm::dot(normal, rays) < 0.0f;
       });
     },
     ray_may_err,
     true},
    // As if the object were far away.
    {{"normal_dot_object", "normal times one ray for all faces, to the mean of all vertices",
      "a mean-direction variant",
      "wrong by the angle between a face's ray and the object's; orthographic: by the ray's tilt too", false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       glm::vec3 sum(0.0f);
       for (const auto& p : scene.positions) sum += p;
       const glm::vec3 ray = sum / static_cast<float>(scene.positions.size()) - scene.view.eye;
       classify_each(scene, front,
                     [ray](glm::vec3 normal, const glm::vec3*) { return glm::dot(normal, ray) < 0.0f; });
     },
     [](const FaceFacts& face, const FacingView& view) {
       return face.sine <= ray_rounding(face) + face.object_sine + (view.perspective ? 0.0 : face.tilt_sine);
     },
     true},
    // As if every ray had the view direction.
    {{"normal_z", "z of the rotated normal before projection", "Outlaw Triad",
      "orthographic: wrong only where a face is edge-on up to rounding; perspective: wrong by the ray's tilt",
      false},
     [](const FacingScene& scene, std::span<std::uint8_t> front) {
       classify_each(scene, front, [forward = scene.view.forward](glm::vec3 normal, const glm::vec3*) {
         return glm::dot(normal, forward) < 0.0f;
       });
     },
     [](const FaceFacts& face, const FacingView& view) {
       return face.sine <= ray_rounding(face) + (view.perspective ? face.tilt_sine : 0.0);
     },
     true},
}};

}  // namespace

std::span<const FacingMethod> facing_methods() {
  return kMethods;
}

}  // namespace edgewise::lab

// Shared by the clipping methods: transform, project, snap, draw. Conversions to integers clamp values that
// are out of range.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "edgewise/contract.h"
#include "frontend/fixed.h"
#include "frontend/transform.h"
#include "lab/clipping/clipping.h"
#include "lab/truth/truth.h"

namespace edgewise::lab {

inline ViewVolume view_of(const ClippingScene& s) {
  return view_volume(camera_of(s.scene), s.size.width, s.size.height);
}

// World position → pixels times w, and w, in float, relative to the camera.
class ToClip {
 public:
  explicit ToClip(const ClippingScene& s)
      : to_screen_({camera_of(s.scene), s.size.width, s.size.height}, glm::dmat4(1.0)) {}
  ClipVertex operator()(glm::vec3 p) const { return as_clip_vertex(transform(to_screen_, p)); }

 private:
  ScreenTransform to_screen_;
};

// Sutherland and Hodgman's clip at one plane: keeps vertices with distance >= 0; lerp(inside, outside, t)
// makes the cut vertices. Returns the number of vertices in `to`, which needs room for one more than `from`.
template <typename Vertex, typename Distance, typename Lerp>
std::size_t cut(std::span<const Vertex> from, Vertex* to, Distance&& distance, Lerp&& lerp) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vertex &a = from[i], &b = from[i + 1 == from.size() ? 0 : i + 1];
    const auto da = static_cast<float>(distance(a)), db = static_cast<float>(distance(b));
    if (da >= 0.0f) to[kept++] = a;
    if (da >= 0.0f && db < 0.0f) to[kept++] = lerp(a, b, da / (da - db));
    if (da < 0.0f && db >= 0.0f) to[kept++] = lerp(b, a, db / (db - da));
  }
  return kept;
}

// The point between two vertices, rounded to float.
inline ClipVertex lerp(const ClipVertex& a, const ClipVertex& b, float t) {
  const auto between = [&](double from, double to) {
    return double{static_cast<float>(from) + t * static_cast<float>(to - from)};
  };
  return {between(a.x, b.x), between(a.y, b.y), between(a.z, b.z), between(a.w, b.w)};
}

struct Projected {
  float x_px, y_px, z01;
};

// In float, like most renderers.
inline Projected divide(const ClipVertex& v, const ViewVolume& view) {
  const auto w = static_cast<float>(v.w), near_z = static_cast<float>(view.near_z);
  const float inverse_w = 1.0f / w, depth_scale = static_cast<float>(view.far_z / (view.far_z - view.near_z));
  return {static_cast<float>(v.x) * inverse_w, static_cast<float>(v.y) * inverse_w,
          depth_scale * (w - near_z) * inverse_w};
}

// Snaps a polygon and appends it as a fan. Drops polygons with NaN or infinite coordinates.
inline void emit(std::span<const Projected> polygon, std::uint32_t payload, bool cull_back,
                 ClippingFrame& frame) {
  for (const Projected& p : polygon)
    if (!std::isfinite(p.x_px) || !std::isfinite(p.y_px) || !std::isfinite(p.z01)) return;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    ScreenTriangle t{};
    const std::size_t corners[3] = {0, i - 1, i};
    for (int k = 0; k < 3; ++k) {
      const Projected& p = polygon[corners[k]];
      t.x_q15[k] = snap(p.x_px);
      t.y_q15[k] = snap(p.y_px);
      t.z[k] = quantize_depth(p.z01);
    }
    t.payload = payload;
    if (!cull_back || contract::signed_area(t) > 0) frame.triangles.push_back(t);
  }
}

inline void emit(std::span<const ClipVertex> polygon, std::uint32_t payload, bool cull_back,
                 ClippingFrame& frame) {
  Projected projected[16];
  std::transform(polygon.begin(), polygon.end(), projected,
                 [&](const ClipVertex& v) { return divide(v, frame.view); });
  emit(std::span<const Projected>(projected, polygon.size()), payload, cull_back, frame);
}

// The sides on which vertices of the triangle lie. nullopt if the triangle draws nothing, because all its
// vertices lie on the same side or one is not finite.
inline std::optional<std::uint16_t> sides_of(const ClipVertex (&v)[3], const ViewVolume& view) {
  std::uint16_t sides[3];
  for (int i = 0; i < 3; ++i) sides[i] = outside_of(v[i], view);
  const unsigned any = sides[0] | sides[1] | sides[2], all = sides[0] & sides[1] & sides[2];
  if ((any & kNotFinite) != 0 || (all & kInvisible) != 0) return std::nullopt;
  return static_cast<std::uint16_t>(any);
}

// A whole draw: to_clip(position) transforms a vertex, per_triangle(vertices, payload) clips and emits.
template <typename Transform, typename PerTriangle>
void draw_transformed(const ClippingScene& scene, ClippingFrame& frame, Transform&& to_clip,
                      PerTriangle&& per_triangle) {
  frame.view = view_of(scene);
  frame.triangles.clear();
  const Mesh& mesh = scene.mesh();
  frame.vertices.resize(mesh.positions.size());
  std::transform(mesh.positions.begin(), mesh.positions.end(), frame.vertices.begin(), to_clip);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    per_triangle({frame.vertices[t.x], frame.vertices[t.y], frame.vertices[t.z]}, i);
  }
  frame.backend->draw(frame.triangles, frame.picture.view(), {kNoTriangle});
}

template <typename PerTriangle>
void draw_clipped(const ClippingScene& scene, ClippingFrame& frame, PerTriangle&& per_triangle) {
  draw_transformed(scene, frame, ToClip(scene), per_triangle);
}

}  // namespace edgewise::lab

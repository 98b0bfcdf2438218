#include "frontend/tasks.h"

#include <algorithm>
#include <array>

#include "edgewise/contract.h"
#include "frontend/clip.h"
#include "frontend/transform.h"

namespace edgewise {

namespace {

// A vertex before snapping.
struct Unsnapped {
  float x_px, y_px, z01;
  SourceVertex source;
};

bool faces_away(std::int64_t area, Cull cull) {
  return cull == Cull::both || (cull == Cull::front && area > 0) || (cull == Cull::back && area < 0);
}

struct Source {
  std::uint32_t payload;
  Cull cull;  // none for a two-sided triangle
};

// Appends a triangle unless it has no area or is culled. unsnapped(k) is vertex k.
template <typename UnsnappedOf>
void emit(const Vertex& a, const Vertex& b, const Vertex& c, const Source& source,
          const FrontendOptions& options, ChunkOutput& out, UnsnappedOf&& unsnapped) {
  FrontendStats& stats = out.stats;
  ++stats.pieces;
  const ScreenTriangle t{
      {a.x_q15, b.x_q15, c.x_q15}, {a.y_q15, b.y_q15, c.y_q15}, {a.z, b.z, c.z}, source.payload};
  const std::int64_t area = contract::signed_area(t);
  if (area == 0 && !options.keep_unsnapped) {
    ++stats.zero_area;
  } else if (faces_away(area, source.cull)) {
    ++stats.culled;
  } else {
    ++stats.emitted;
    if (options.keep_unsnapped || out.sources != nullptr) {
      const Unsnapped u = unsnapped(0), v = unsnapped(1), w = unsnapped(2);
      if (options.keep_unsnapped)
        out.unsnapped[out.count] = {
            {u.x_px, v.x_px, w.x_px}, {u.y_px, v.y_px, w.y_px}, {u.z01, v.z01, w.z01}};
      if (out.sources != nullptr) out.sources->push_back({u.source, v.source, w.source});
    }
    out.triangles[out.count++] = t;
  }
}

// The three corners of a triangle that must be clipped. A corner that is inside keeps its snapped position,
// which it has in other triangles too.
template <typename Geometry>
void clip(const Vertex (&corners)[3], std::uint32_t sides, const Source& source,
          const FrontendOptions& options, ChunkOutput& out, const Geometry& geometry) {
  FrontendStats& stats = out.stats;
  ++stats.clipped;
  if (sides & kNear) ++stats.clipped_near;
  if (sides & kFar) ++stats.clipped_far;
  if (sides & kGuard) ++stats.clipped_guard;
  ClipVertex triangle[3];
  std::uint32_t planes = 0, common = kInvisible;
  for (int k = 0; k < 3; ++k) {
    triangle[k] = geometry.clip_vertex(k);
    if (is_inside(corners[k])) triangle[k].corner = k;
    const std::uint32_t outside = is_inside(corners[k]) ? 0 : outside_of(triangle[k], geometry.view);
    planes |= outside, common &= outside;
  }
  // A new vertex on a near plane close to the camera may lie beyond the guard band, wherever its edge ends.
  if ((planes & kNear) != 0) planes |= kGuard;
  Clipper clipper;
  const auto polygon = clipper.clip(triangle, static_cast<std::uint16_t>(planes), geometry.view);
  if (common != 0 || polygon.size() < 3) {
    ++stats.outside;
    return;
  }
  const auto is_projectable = [](const ClipVertex& v) { return v.corner >= 0 || can_project(v); };
  if (!std::all_of(polygon.begin(), polygon.end(), is_projectable)) {
    ++stats.not_in_front;
    return;
  }
  std::array<Vertex, Clipper::kMaxVertices> snapped;
  std::transform(polygon.begin(), polygon.end(), snapped.begin(), [&](const ClipVertex& v) {
    return v.corner >= 0 ? corners[v.corner] : Vertex{snap(x_px(v)), snap(y_px(v)), geometry.depth(v), 0};
  });
  const Pieces pieces = split({snapped.data(), polygon.size()});
  for (std::size_t i = 0; i < pieces.count; ++i) {
    const auto& at = pieces.corners[i];
    emit(snapped[at[0]], snapped[at[1]], snapped[at[2]], source, options, out, [&](std::size_t k) {
      const ClipVertex& v = polygon[at[k]];
      if (v.corner >= 0) return geometry.unsnapped(v.corner);
      return Unsnapped{x_px(v), y_px(v), geometry.depth01(v), {v.z, v.w, clipper.weights(v)}};
    });
  }
}

// Adds a triangle, clipped if necessary.
template <typename Geometry>
void add(const Vertex (&corners)[3], const Source& source, const FrontendOptions& options, ChunkOutput& out,
         const Geometry& geometry) {
  const auto& [a, b, c] = corners;
  const std::uint32_t any = a.outside | b.outside | c.outside, common = a.outside & b.outside & c.outside;
  if ((any & kNotFinite) != 0)
    ++out.stats.not_finite;
  else if ((common & kInvisible) != 0)
    ++out.stats.outside;
  else if ((any & kMustClip) != 0)
    clip(corners, any & kMustClip, source, options, out, geometry);
  else
    emit(a, b, c, source, options, out, [&](int k) { return geometry.unsnapped(k); });
}

TriangleState state_between(const FrontendStats& before, const FrontendStats& after) {
  const auto grew = [&](std::uint64_t FrontendStats::*count) { return after.*count > before.*count; };
  if (grew(&FrontendStats::emitted))
    return grew(&FrontendStats::clipped) ? TriangleState::clipped : TriangleState::active;
  if (grew(&FrontendStats::culled)) return TriangleState::culled;
  if (grew(&FrontendStats::zero_area)) return TriangleState::zero_area;
  if (grew(&FrontendStats::not_in_front)) return TriangleState::not_in_front;
  return grew(&FrontendStats::not_finite) ? TriangleState::not_finite : TriangleState::outside;
}

// Calls add_it() and derives the triangle's state from the counts that it changed.
template <typename Task, typename AddIt>
void add_and_record_state(const Task& task, std::size_t triangle, ChunkOutput& out, AddIt&& add_it) {
  if (task.states == nullptr) return add_it();
  const FrontendStats before = out.stats;
  add_it();
  task.states[triangle] = state_between(before, out.stats);
}

// The vertices of one triangle of a mesh, by corner.
struct MeshGeometry {
  const MeshTask& task;
  const ViewVolume& view = task.view;
  glm::uvec3 triangle;

  glm::vec3 position(int k) const { return task.mesh.positions[triangle[k]]; }
  ClipVertex clip_vertex(int k) const { return task.to_screen(position(k)); }
  double above_near(const ClipVertex& v) const {
    return task.to_screen.has_z ? v.z / v.w * contract::kDepthRange : task.depth.above_near(v.w);
  }
  std::uint32_t depth(const ClipVertex& v) const { return round_depth(above_near(v)); }
  float depth01(const ClipVertex& v) const {
    return static_cast<float>(above_near(v) / contract::kDepthRange);
  }
  Unsnapped unsnapped(int k) const {
    const glm::vec3 v = transform(task.to_screen, position(k));
    const float inverse_w = 1.0f / v.z;
    const ClipVertex c = task.to_screen.has_z ? clip_vertex(k) : as_clip_vertex(v);
    return {v.x * inverse_w, v.y * inverse_w, depth01(c), {c.z, double{v.z}, weights_of_corner(k)}};
  }
};

struct StreamGeometry {
  const StreamTriangle& triangle;
  ViewVolume view;

  ClipVertex clip_vertex(int k) const {
    const glm::dvec3 v(triangle.vertex[k]);
    return {v.x, v.y, v.z, 1.0};
  }
  std::uint32_t depth(const ClipVertex& v) const { return quantize_depth(depth01(v)); }
  float depth01(const ClipVertex& v) const { return static_cast<float>(v.z); }
  Unsnapped unsnapped(int k) const {
    const glm::vec3 v = triangle.vertex[k];
    return {v.x, v.y, v.z, {double{v.z}, 1.0, weights_of_corner(k)}};
  }
  Vertex vertex(int k) const {
    const std::uint32_t outside = outside_of(clip_vertex(k), view);
    const glm::vec3 v = triangle.vertex[k];
    if ((outside & (kMustClip | kNotFinite)) != 0) return {0, 0, 0, outside};
    return {snap(v.x), snap(v.y), quantize_depth(v.z), outside};
  }
};

}  // namespace

void add_one(const MeshTask& task, std::size_t triangle, const Vertex (&corners)[3], ChunkOutput& out) {
  const Cull cull = task.mesh.has_flag(triangle, kTwoSided) ? Cull::none : task.options.cull;
  add_and_record_state(task, triangle, out, [&] {
    add(corners, {task.first_id + static_cast<std::uint32_t>(triangle), cull}, task.options, out,
        MeshGeometry{.task = task, .triangle = task.mesh.triangles[triangle]});
  });
}

void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out) {
  const StreamTriangle& t = task.stream.triangles[triangle];
  const StreamGeometry geometry{t, {double(task.options.width), double(task.options.height), 0.0, 1.0}};
  const bool ids = task.options.payload == Payload::id;
  const Source source{ids ? task.options.first_id + static_cast<std::uint32_t>(triangle) : t.colour,
                      task.options.cull};
  add_and_record_state(task, triangle, out, [&] {
    add({geometry.vertex(0), geometry.vertex(1), geometry.vertex(2)}, source, task.options, out, geometry);
  });
}

}  // namespace edgewise

#include "frontend/tasks.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "edgewise/contract.h"
#include "frontend/clip.h"
#include "frontend/transform.h"

namespace edgewise {

namespace {

// A vertex before snapping.
struct Unsnapped {
  double x_px, y_px, z01;
  SourceVertex source;
};

// Of a new vertex.
glm::dvec2 position_px(const ClipVertex& v, bool fine) {
  const glm::dvec2 px(v.x / v.w, v.y / v.w);
  return fine ? px : glm::dvec2(rounded_to_float(px.x), rounded_to_float(px.y));
}

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
      const auto real = [](double value) { return static_cast<float>(value); };
      if (options.keep_unsnapped)
        out.unsnapped[out.count] = {{real(u.x_px), real(v.x_px), real(w.x_px)},
                                    {real(u.y_px), real(v.y_px), real(w.y_px)},
                                    {real(u.z01), real(v.z01), real(w.z01)}};
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
    if (v.corner >= 0) return corners[v.corner];
    const glm::dvec2 at = position_px(v, geometry.fine);
    return Vertex{snap(at.x, options.subpixel_bits), snap(at.y, options.subpixel_bits), geometry.depth(v), 0};
  });
  const Pieces pieces = split({snapped.data(), polygon.size()});
  for (std::size_t i = 0; i < pieces.count; ++i) {
    const auto& at = pieces.corners[i];
    emit(snapped[at[0]], snapped[at[1]], snapped[at[2]], source, options, out, [&](std::size_t k) {
      const ClipVertex& v = polygon[at[k]];
      if (v.corner >= 0) return geometry.unsnapped(v.corner);
      const glm::dvec2 position = position_px(v, geometry.fine);
      return Unsnapped{position.x, position.y, geometry.depth01(v), {v.z, v.w, clipper.weights(v)}};
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
  const bool fine = task.is_fine();
  glm::uvec3 triangle;

  glm::vec3 position(int k) const { return task.mesh.positions[triangle[k]]; }
  ClipVertex clip_vertex(int k) const { return task.to_screen(position(k)); }
  double above_near(const ClipVertex& v) const {
    return task.to_screen.has_z ? v.z / v.w * contract::kDepthRange : task.depth.above_near(v.w);
  }
  std::uint32_t depth(const ClipVertex& v) const { return round_depth(above_near(v)); }
  double depth01(const ClipVertex& v) const { return above_near(v) / contract::kDepthRange; }
  Unsnapped unsnapped(int k) const {
    if (fine) {
      const ClipVertex exact = clip_vertex(k);
      const double inverse_w = 1.0 / exact.w;
      return {
          exact.x * inverse_w, exact.y * inverse_w, depth01(exact), {exact.z, exact.w, weights_of_corner(k)}};
    }
    const glm::vec3 v = transform(task.to_screen, position(k));
    const float inverse_w = 1.0f / v.z;
    const ClipVertex c = task.to_screen.has_z ? clip_vertex(k) : as_clip_vertex(v);
    return {double{v.x * inverse_w},
            double{v.y * inverse_w},
            depth01(c),
            {c.z, double{v.z}, weights_of_corner(k)}};
  }
};

template <typename Triangle>
struct StreamGeometry {
  const Triangle& triangle;
  ViewVolume view;
  int bits;
  const bool fine = std::is_same_v<Triangle, ExactStreamTriangle> || is_fine(bits);

  ClipVertex clip_vertex(int k) const {
    const glm::dvec3 v(triangle.vertex[k]);
    return {v.x, v.y, v.z, 1.0};
  }
  std::uint32_t depth(const ClipVertex& v) const { return quantize_depth(depth01(v)); }
  double depth01(const ClipVertex& v) const { return fine ? v.z : rounded_to_float(v.z); }
  Unsnapped unsnapped(int k) const {
    const ClipVertex v = clip_vertex(k);
    return {v.x, v.y, v.z, {v.z, 1.0, weights_of_corner(k)}};
  }
  Vertex vertex(int k) const {
    const ClipVertex v = clip_vertex(k);
    const std::uint32_t outside = outside_of(v, view);
    if ((outside & (kMustClip | kNotFinite)) != 0) return {0, 0, 0, outside};
    return {snap(v.x, bits), snap(v.y, bits), quantize_depth(v.z), outside};
  }
};

template <typename Triangle>
void add_one(const StreamTask& task, const Triangle& t, std::size_t index, ChunkOutput& out) {
  const FrontendOptions& options = task.options;
  const StreamGeometry<Triangle> geometry{
      t, {double(options.width), double(options.height), 0.0, 1.0}, options.subpixel_bits};
  const bool ids = options.payload == Payload::id;
  const Source source{ids ? options.first_id + static_cast<std::uint32_t>(index) : t.colour, options.cull};
  add_and_record_state(task, index, out, [&] {
    add({geometry.vertex(0), geometry.vertex(1), geometry.vertex(2)}, source, options, out, geometry);
  });
}

}  // namespace

void add_one(const MeshTask& task, std::size_t triangle, const Vertex (&corners)[3], ChunkOutput& out) {
  const Cull cull = task.mesh.has_flag(triangle, kTwoSided) ? Cull::none : task.options.cull;
  add_and_record_state(task, triangle, out, [&] {
    add(corners, {task.first_id + static_cast<std::uint32_t>(triangle), cull}, task.options, out,
        MeshGeometry{.task = task, .triangle = task.mesh.triangles[triangle]});
  });
}

void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out) {
  if (task.stream.exact.empty())
    add_one(task, task.stream.triangles[triangle], triangle, out);
  else
    add_one(task, task.stream.exact[triangle], triangle, out);
}

}  // namespace edgewise

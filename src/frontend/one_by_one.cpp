#include "frontend/one_by_one.h"

#include <algorithm>
#include <array>

#include "edgewise/contract.h"
#include "frontend/pieces.h"
#include "frontend/transform.h"

namespace edgewise {

namespace {

UnsnappedTriangle unsnapped_triangle(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
  const float wa = 1.0f / a.w, wb = 1.0f / b.w, wc = 1.0f / c.w;
  return {{a.x * wa, b.x * wb, c.x * wc}, {a.y * wa, b.y * wb, c.y * wc}, {a.z * wa, b.z * wb, c.z * wc}};
}

// True, and counted, if the triangle is not finite or lies beyond one side of the view.
bool drop(const Vertex& a, const Vertex& b, const Vertex& c, FrontendStats& stats) {
  if ((a.outside | b.outside | c.outside) & kNotFinite) {
    ++stats.not_finite;
    return true;
  }
  if (a.outside & b.outside & c.outside & kInvisible) {
    ++stats.outside;
    return true;
  }
  return false;
}

bool faces_away(std::int64_t area, Cull cull) {
  return cull == Cull::both || (cull == Cull::front && area > 0) || (cull == Cull::back && area < 0);
}

struct Source {
  std::uint32_t payload;
  Cull cull;  // none for a two-sided triangle
};

// Appends a triangle unless it has no area or is culled. unsnapped() is called only with keep_unsnapped.
template <typename Unsnapped>
void emit(const Vertex& a, const Vertex& b, const Vertex& c, const Source& source,
          const FrontendOptions& options, ChunkOutput& out, Unsnapped&& unsnapped) {
  FrontendStats& stats = out.stats;
  ++stats.pieces;
  const ScreenTriangle t{
      {a.x_sub, b.x_sub, c.x_sub}, {a.y_sub, b.y_sub, c.y_sub}, {a.z, b.z, c.z}, source.payload};
  const std::int64_t area = contract::signed_area(t);
  if (area == 0 && !options.keep_unsnapped) {
    ++stats.zero_area;
  } else if (faces_away(area, source.cull)) {
    ++stats.culled;
  } else {
    ++stats.emitted;
    if (options.keep_unsnapped) out.unsnapped.data()[out.count] = unsnapped();
    out.triangles.data()[out.count++] = t;
  }
}

// depth_of(vertex) returns the depth of a vertex in clip space, in contract units.
template <typename DepthOf>
void clip(const ClipVertex (&triangle)[3], std::uint32_t sides, const Source& source,
          const FrontendOptions& options, ChunkOutput& out, DepthOf&& depth_of) {
  FrontendStats& stats = out.stats;
  ++stats.clipped;
  if (sides & kNear) ++stats.clipped_near;
  if (sides & kFar) ++stats.clipped_far;
  if (sides & kGuard) ++stats.clipped_guard;
  Clipper clipper;
  const auto polygon = clipper.clip(triangle, static_cast<std::uint16_t>(sides));
  if (polygon.size() < 3) {
    ++stats.outside;
    return;
  }
  if (!std::all_of(polygon.begin(), polygon.end(), can_project)) {
    ++stats.not_in_front;
    return;
  }
  std::array<Vertex, Clipper::kMaxVertices> snapped;
  std::transform(polygon.begin(), polygon.end(), snapped.begin(),
                 [&](const ClipVertex& v) { return project(v, depth_of(v)); });
  const Pieces pieces = split({snapped.data(), polygon.size()});
  for (std::size_t i = 0; i < pieces.count; ++i) {
    const auto [a, b, c] = pieces.corners[i];
    emit(snapped[a], snapped[b], snapped[c], source, options, out,
         [&, a = a, b = b, c = c] { return unsnapped_triangle(polygon[a], polygon[b], polygon[c]); });
  }
}

// Adds a triangle, clipped if necessary. clip_of(k) returns vertex k in clip space.
template <typename ClipOf, typename DepthOf>
void add(const Vertex& a, const Vertex& b, const Vertex& c, const Source& source,
         const FrontendOptions& options, ChunkOutput& out, ClipOf&& clip_of, DepthOf&& depth_of) {
  if (drop(a, b, c, out.stats)) return;
  const std::uint32_t sides = (a.outside | b.outside | c.outside) & kMustClip;
  if (sides == 0)
    emit(a, b, c, source, options, out,
         [&] { return unsnapped_triangle(clip_of(0), clip_of(1), clip_of(2)); });
  else
    clip({clip_of(0), clip_of(1), clip_of(2)}, sides, source, options, out, depth_of);
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

}  // namespace

void add_one(const MeshTask& task, std::size_t triangle, ChunkOutput& out) {
  const glm::uvec3 t = task.mesh.triangles[triangle];
  const auto clip_of = [&](int k) { return transform(task.to_screen, task.mesh.positions[t[k]]); };
  const auto depth_of = [&](const ClipVertex& v) { return task.depth.units(v.w); };
  const Cull cull = task.mesh.has_flag(triangle, kTwoSided) ? Cull::none : task.options.cull;
  add_and_record_state(task, triangle, out, [&] {
    add(task.vertices[t.x], task.vertices[t.y], task.vertices[t.z],
        {static_cast<std::uint32_t>(triangle), cull}, task.options, out, clip_of, depth_of);
  });
}

void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out) {
  const StreamTriangle& t = task.stream.triangles[triangle];
  const auto width = static_cast<float>(task.options.width), height = static_cast<float>(task.options.height);
  const auto clip_of = [&](int k) {
    const glm::vec3 v = t.vertex[k];
    return ClipVertex{v.x, v.y, v.z, 1.0f};
  };
  const auto depth_of = [](const ClipVertex& v) { return quantize_depth(v.z); };  // w is 1
  const auto vertex = [&](int k) {
    const ClipVertex v = clip_of(k);
    return make_vertex(v, depth_of(v), width, height);
  };
  const bool ids = task.options.payload == Payload::id;
  const Source source{ids ? static_cast<std::uint32_t>(triangle) : t.colour, task.options.cull};
  add_and_record_state(task, triangle, out, [&] {
    add(vertex(0), vertex(1), vertex(2), source, task.options, out, clip_of, depth_of);
  });
}

}  // namespace edgewise

// Runs the steps of the front end. Each step has a file of its own:
// - vertices: transform.cpp
// - triangles: assemble.cpp for meshes, stream.cpp for streams; one_by_one.cpp and clip.cpp for special cases
// - colours: shade.cpp
// - output in submission order: chunks.h
// A mesh with clusters is cut into parts (mesh_clusters.h); others are one part. Consecutive parts form a
// group, which is cut into chunks (chunks.h).
#include "edgewise/frontend.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "edgewise/contract.h"
#include "edgewise/limits.h"
#include "frontend/chunks.h"
#include "frontend/mesh_clusters.h"
#include "frontend/shade.h"
#include "frontend/stream_source.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"
#include "frontend/view.h"

namespace edgewise {

namespace {

constexpr Cull kCullModes[] = {Cull::none, Cull::back, Cull::front, Cull::both};

void check(const Mesh& mesh) {
  if (mesh.colours.size() != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(mesh.colours.size()) + " colours");
  if (!mesh.flags.empty() && mesh.flags.size() != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(mesh.flags.size()) + " flags");
  if (!mesh.flags.empty() && mesh.has_flag(0, kSameFace))
    throw std::invalid_argument("a mesh's first triangle has kSameFace");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(mesh.normals.size()) + " normals");
  if (!mesh.clusters.empty() && mesh.clusters.size() != cluster_count(mesh))
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.clusters.size()) +
                                " clusters instead of " + std::to_string(cluster_count(mesh)));
}

const Mesh& mesh_of(const Scene& scene, const Instance& instance) {
  if (instance.mesh >= scene.meshes.size())
    throw std::invalid_argument("an instance names mesh " + std::to_string(instance.mesh) + " of " +
                                std::to_string(scene.meshes.size()));
  return scene.meshes[instance.mesh];
}

void throw_if_vertex_missing(const Mesh& mesh) {
  const auto largest = [](glm::uvec3 t) { return std::max({t.x, t.y, t.z}); };
  const auto bad = std::find_if(mesh.triangles.begin(), mesh.triangles.end(),
                                [&](glm::uvec3 t) { return largest(t) >= mesh.positions.size(); });
  if (bad == mesh.triangles.end()) return;
  throw std::invalid_argument("triangle " + std::to_string(bad - mesh.triangles.begin()) + " names vertex " +
                              std::to_string(largest(*bad)) + " of " + std::to_string(mesh.positions.size()));
}

std::size_t checked_count(std::size_t triangles) {
  if (triangles > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles) + " triangles are more than " +
                                std::to_string(kMaxTriangles));
  return triangles;
}

std::size_t submitted(const Drawable& drawable) {
  if (const auto* stream = std::get_if<TriangleStream>(&drawable)) return stream->triangles.size();
  const auto& scene = std::get<Scene>(drawable);
  std::size_t triangles = 0;
  for (const auto& instance : scene.instances) triangles += mesh_of(scene, instance).triangles.size();
  return triangles;
}

}  // namespace

std::span<const Cull> cull_modes() {
  return kCullModes;
}

std::string_view name_of(Cull cull) {
  switch (cull) {
    case Cull::none:
      return "none";
    case Cull::back:
      return "back";
    case Cull::front:
      return "front";
    case Cull::both:
      return "both";
  }
  throw std::invalid_argument("not a culling mode");
}

FrontendStats& FrontendStats::operator+=(const FrontendStats& o) {
  meshes += o.meshes, meshes_culled += o.meshes_culled;
  triangles += o.triangles, whole_mesh += o.whole_mesh, not_finite += o.not_finite, outside += o.outside;
  not_in_front += o.not_in_front;
  clipped += o.clipped, clipped_near += o.clipped_near, clipped_far += o.clipped_far,
      clipped_guard += o.clipped_guard;
  pieces += o.pieces, culled += o.culled, zero_area += o.zero_area, emitted += o.emitted;
  return *this;
}

// Of an instance: clusters of its mesh, or all of it.
struct MeshPart {
  MeshTask task;
  ShadeTask light;
  std::size_t first_vertex;  // in State::vertices
  // Sides beyond which all finite vertices lie. 0 for clusters, which are in view.
  std::uint32_t common;

  // True if all of it lies beyond one side of the view. False without a finite vertex.
  bool out_of_sight() const { return (common & kNotFinite) == 0 && common != 0; }
};

struct Frontend::State {
  // A group holds consecutive parts: most are too small to be worth several threads alone.
  static constexpr std::size_t kMaxParts = kWorthThreads;
  // More threads get larger groups, since they meet at each group's end. All vertices of a group must fit the
  // caches.
  std::size_t max_vertices() const {
    const auto eights = static_cast<std::size_t>(options.threads / 8);
    return std::max(4 * kWorthThreads, eights * ClusterPart::kMaxVertices);
  }
  std::vector<MeshPart> group;
  ClusterPart cluster_part;
  Chunks vertex_chunks, triangle_chunks;
  std::size_t group_vertices = 0;  // room for them, in `vertices`
  // Tasks index vertices as the mesh does, but only a part's are there. So the first `unused` records, as
  // many as the largest mesh with clusters has vertices, are never touched: a task's pointer to what would be
  // vertex 0 stays inside the buffer.
  std::size_t unused = 0;
  Buffer<Vertex> vertices;

  InOrder order;
  Buffer<ScreenTriangle> screen;
  Buffer<UnsnappedTriangle> unsnapped;
  std::size_t unsnapped_count = 0;  // valid ones
  Buffer<TriangleState> states;
  std::size_t state_count = 0;  // valid ones
  FrontendStats stats;
  FrontendOptions options;
  std::optional<StreamSource> source;

  // Throws std::invalid_argument.
  void set(const FrontendOptions& o) {
    unsnapped_count = state_count = 0;
    for (const int side : {o.width, o.height})
      if (side < 1 || side > contract::kMaxImageSide)
        throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                    std::to_string(contract::kMaxImageSide));
    if (o.threads < 1 || o.threads > kMaxThreads)
      throw std::invalid_argument(std::to_string(o.threads) + " threads are outside 1 to " +
                                  std::to_string(kMaxThreads));
    options = o;
    options.target = resolve(o.target);
  }

  void transform_group() {
    const TransformKernel transform = transform_kernel(options.target);
    vertices.reserve(unused + group_vertices);
    for (MeshPart& part : group)
      part.task.vertices = vertices.data() + (unused + part.first_vertex - part.task.vertex_range.first);
    parallel_for(workers_for(vertex_chunks.total(), options.threads), static_cast<int>(vertex_chunks.size()),
                 [&](int chunk) {
                   for (const PartRange& range : vertex_chunks[static_cast<std::size_t>(chunk)]) {
                     MeshPart& part = group[range.part];
                     std::atomic_ref(part.common) &= transform(part.task, range.begin, range.end);
                   }
                 });
  }

  // Copies a chunk's output to its place in the frame's output. If there is no room, run() repeats the frame
  // with more.
  void place(const ChunkOutput& out, std::size_t at) {
    if (at + out.count > screen.capacity()) return;
    std::copy_n(out.triangles.data(), out.count, screen.data() + at);
    if (options.keep_unsnapped) std::copy_n(out.unsnapped.data(), out.count, unsnapped.data() + at);
  }

  // Replaces ids by colours in the output's triangles from `first` on.
  void set_colours(const MeshPart& part, std::size_t first, ChunkOutput& out, ShadeKernel shade) {
    if (options.shade) return shade(part.light, out, first);
    const Mesh& mesh = part.task.mesh;
    std::for_each_n(out.triangles.data() + first, out.count - first, [&](ScreenTriangle& t) {
      const std::uint32_t index = t.payload - part.task.first_id;
      t.payload = mesh.colours[index];
    });
  }

  void assemble_group() {
    for (const MeshPart& part : group) {
      if (!part.out_of_sight()) continue;
      ++stats.meshes_culled;
      drop(part.task, 0, part.task.mesh.triangles.size());
    }
    const AssembleKernel assemble = assemble_kernel(options.target);
    const ShadeKernel shade = shade_kernel(options.target);
    std::atomic<bool> all_exist{true};
    const auto make = [&](std::size_t chunk, ChunkOutput& out) {
      for (const PartRange& range : triangle_chunks[chunk]) {
        const MeshPart& part = group[range.part];
        const std::size_t first = out.count;
        if (part.out_of_sight()) continue;
        if (!assemble(part.task, range.begin, range.end, range.allowed, out))
          all_exist = false;
        else if (options.payload == Payload::colour)
          set_colours(part, first, out, shade);
      }
    };
    order.for_each_chunk(triangle_chunks.size(), triangle_chunks.total(), make,
                         [&](const ChunkOutput& out, std::size_t at) { place(out, at); });
    if (all_exist) return;
    for (const MeshPart& part : group)
      if (!part.out_of_sight()) throw_if_vertex_missing(part.task.mesh);
    throw std::invalid_argument("a mesh's clusters were made for other triangles");
  }

  // Drops triangles of a mesh without looking at them.
  void drop(const MeshTask& task, std::size_t first, std::size_t count) {
    stats.whole_mesh += count;
    if (options.keep_states) std::fill_n(task.states + first, count, TriangleState::outside_with_mesh);
  }

  void start_group() {
    group.clear();
    vertex_chunks.clear();
    triangle_chunks.clear();
    group_vertices = 0;
  }

  void run_group() {
    if (group.empty()) return;
    transform_group();
    assemble_group();
    start_group();
  }

  // Returns the new part's index. Its vertices and triangles must then be added to the chunks.
  std::size_t add_part(const MeshTask& task, const ShadeTask& light, std::uint32_t common) {
    if (group_vertices + task.vertex_range.size() > max_vertices() || group.size() == kMaxParts) run_group();
    group.push_back({task, light, group_vertices, common});
    group_vertices += task.vertex_range.size();
    return group.size() - 1;
  }

  void add_whole(const MeshTask& task, const ShadeTask& light) {
    const std::size_t part = add_part(task, light, kInvisible | kNotFinite);
    vertex_chunks.add(part, 0, task.mesh.positions.size());
    triangle_chunks.add(part, 0, task.mesh.triangles.size(), task.vertex_range);
  }

  void add_parts(MeshTask task, const ShadeTask& light) {
    const Mesh& mesh = task.mesh;
    const ViewSides sides(task.to_screen, task.view);
    const auto drop_if_outside = [&](std::size_t cluster) {
      if (!sides.exclude(mesh.clusters[cluster])) return false;
      const ClusterTriangles outside = triangles_of(mesh, cluster);
      drop(task, outside.first, outside.count);
      return true;
    };
    cluster_part.start(mesh, mesh.clusters);
    bool in_view = false;
    while (cluster_part.take(drop_if_outside)) {
      in_view = true;
      task.vertex_range = cluster_part.range();
      const std::size_t part = add_part(task, light, 0);
      cluster_part.for_each_vertex_range(
          [&](std::size_t first, std::size_t count) { vertex_chunks.add(part, first, count); });
      cluster_part.for_each_triangle_range([&](std::size_t first, std::size_t count, VertexRange range) {
        triangle_chunks.add(part, first, count, range);
      });
    }
    stats.meshes_culled += !in_view;
  }

  // Makes room for any view of the scene, so that a camera that turns allocates nothing. At least one granule
  // of vertices lies between two ranges of a part.
  void reserve_for_clusters(const Scene& scene) {
    std::size_t clusters = 0, triangles = 0, most_vertices = max_vertices();
    unused = 0;
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = mesh_of(scene, instance);
      clusters += mesh.clusters.size();
      triangles += mesh.triangles.size();
      most_vertices = std::max(most_vertices, mesh.positions.size());
      if (!mesh.clusters.empty()) unused = std::max(unused, mesh.positions.size());
    }
    // A granule of vertices stays aligned to cache lines.
    unused = (unused + ClusterPart::kGranule - 1) / ClusterPart::kGranule * ClusterPart::kGranule;
    if (clusters == 0) return;
    const std::size_t parts = std::min(clusters + scene.instances.size(), kMaxParts);
    vertices.reserve(unused + most_vertices);
    group.reserve(parts);
    vertex_chunks.reserve(most_vertices, parts + most_vertices / (2 * ClusterPart::kGranule));
    triangle_chunks.reserve(triangles, clusters + parts);
  }

  void run_scene(const Scene& scene) {
    start_group();
    reserve_for_clusters(scene);
    const ViewVolume view = view_volume(scene.camera, options.width, options.height);
    const glm::dmat3 pixels = pixels_of(scene.camera, options.width, options.height);
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(scene.to_light));
    const ViewDepth depth(view.near_z, view.far_z);
    std::size_t first_triangle = 0;  // in submission order, of the instance
    for (const auto& instance : scene.instances) {
      const Mesh& mesh = mesh_of(scene, instance);
      check(mesh);
      const glm::dmat4 model = model_matrix(instance);
      const MeshTask task{.options = options,
                          .mesh = mesh,
                          .view = view,
                          .to_screen = {pixels, scene.camera.position, model},
                          .depth = depth,
                          .vertices = nullptr,
                          .vertex_range = {0, mesh.positions.size()},
                          .first_id = static_cast<std::uint32_t>(first_triangle),
                          .states = options.keep_states ? states.data() + first_triangle : nullptr};
      ++stats.meshes;
      stats.triangles += mesh.triangles.size();
      const ShadeTask light{mesh, cofactor_matrix(model), to_light, task.first_id};
      mesh.clusters.empty() ? add_whole(task, light) : add_parts(task, light);
      first_triangle += mesh.triangles.size();
    }
    run_group();
  }

  void run_stream(const TriangleStream& stream) {
    const StreamKernel kernel = stream_kernel(options.target);
    const StreamTask task{options, stream, options.keep_states ? states.data() : nullptr};
    const std::size_t count = stream.triangles.size();
    stats.triangles = count;
    order.for_each_chunk((count + kChunkTriangles - 1) / kChunkTriangles, count,
                         [&](std::size_t chunk, ChunkOutput& out) {
                           kernel(task, chunk * kChunkTriangles,
                                  std::min(count, (chunk + 1) * kChunkTriangles), out);
                         },
                         [&](const ChunkOutput& out, std::size_t at) { place(out, at); });
  }

  void run_once(const Drawable& drawable, std::size_t room) {
    screen.reserve(room);
    if (options.keep_unsnapped) unsnapped.reserve(screen.capacity());
    order.start_frame(options.threads, options.keep_unsnapped);
    stats = {};
    if (const auto* scene = std::get_if<Scene>(&drawable))
      run_scene(*scene);
    else
      run_stream(std::get<TriangleStream>(drawable));
    stats += order.stats();
  }

  void run(const Drawable& drawable) {
    const std::size_t count = checked_count(submitted(drawable));
    if (options.keep_states) states.reserve(count);
    run_once(drawable, count);
    // Clipping added more triangles than were dropped. This is rare, and the memory then suffices for the
    // next frames of the kind.
    if (order.total() > screen.capacity()) run_once(drawable, checked_count(order.total()));
    if (options.keep_unsnapped) unsnapped_count = order.total();
    if (options.keep_states) state_count = count;
  }
};

Frontend::Frontend() : state_(std::make_unique<State>()) {}
Frontend::~Frontend() = default;
Frontend::Frontend(Frontend&&) noexcept = default;
Frontend& Frontend::operator=(Frontend&&) noexcept = default;

ScreenTriangles Frontend::run(const Drawable& drawable, const FrontendOptions& options) {
  State& s = *state_;
  s.set(options);
  s.run(drawable);
  return {{s.screen.data(), s.order.total()}, options.width, options.height};
}

TriangleSource* Frontend::start_source(const Drawable& drawable, const FrontendOptions& options,
                                       int workers) {
  State& s = *state_;
  s.set(options);
  const auto* stream = std::get_if<TriangleStream>(&drawable);
  if (stream == nullptr || options.keep_unsnapped || options.keep_states) return nullptr;
  s.stats = {};
  s.stats.triangles = checked_count(stream->triangles.size());
  s.order.start_frame(workers, false);
  return &s.source.emplace(s.options, *stream, s.order);
}

void Frontend::end_source() {
  state_->source.reset();
  state_->stats += state_->order.stats();
}

const FrontendStats& Frontend::stats() const {
  return state_->stats;
}

std::span<const UnsnappedTriangle> Frontend::unsnapped() const {
  return {state_->unsnapped.data(), state_->unsnapped_count};
}

std::span<const TriangleState> Frontend::states() const {
  return {state_->states.data(), state_->state_count};
}

}  // namespace edgewise

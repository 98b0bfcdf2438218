#include "frontend/scene_maker.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

#include "core/finite.h"
#include "frontend/scene_checks.h"
#include "frontend/triangle_ids.h"

namespace edgewise {

namespace {

void check(const Mesh& mesh) {
  check_per_triangle(mesh, mesh.colours.size(), "colours");
  check_flags(mesh);
  if (!mesh.flags.empty() && mesh.has_flag(0, kSameFace))
    throw std::invalid_argument("a mesh's first triangle has kSameFace");
  if (!mesh.normals.empty()) check_per_triangle(mesh, mesh.normals.size(), "normals");
  if (!is_finite(mesh.origin)) throw std::invalid_argument("a mesh's origin is not finite");
  if (!mesh.clusters.empty() && mesh.clusters.size() != cluster_count(mesh))
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.clusters.size()) +
                                " clusters instead of " + std::to_string(cluster_count(mesh)));
}

}  // namespace

void SceneMaker::set(const Scene& scene, const FrontendOptions& options, SimdTarget target) {
  scene_ = &scene, options_ = &options;
  number_triangles(scene, first_ids_);
  view_.emplace(scene, options.width, options.height, is_fine(options.subpixel_bits));
  for (const Instance& instance : scene.instances) check(scene.meshes[instance.mesh]), check(instance);
  to_light_ = glm::normalize(glm::dvec3(scene.to_light));
  transform_ = transform_kernel(target);
  index_range_ = index_range_kernel(target);
  assemble_ = assemble_kernel(target);
  shade_ = shade_kernel(target);
}

void SceneMaker::start_workers(int workers, std::size_t inputs, TriangleState* states) {
  TriangleMaker::start_workers(workers, inputs, states);
  stats_.meshes = scene_->instances.size();
  vertex_missing_ = false;
  sights_.assign(scene_->instances.size(), unknown);
  std::size_t most_vertices = 0;
  for (std::size_t i = 0; i < scene_->instances.size(); ++i)
    most_vertices = std::max(most_vertices, mesh_of(i).positions.size());
  if (workers_.size() < static_cast<std::size_t>(workers))
    workers_ = std::vector<Worker>(static_cast<std::size_t>(workers));
  for (Worker& w : workers_) {
    w.instance = ~std::size_t{0};
    w.window.reserve(most_vertices);
  }
}

void SceneMaker::append(int worker, std::size_t begin, std::size_t end, ChunkOutput& out) {
  Worker& w = workers_[static_cast<std::size_t>(worker)];
  for (std::size_t instance = instance_of(first_ids_, begin); begin < end; ++instance) {
    const std::size_t first = first_ids_[instance], last = std::min(end, first_ids_[instance + 1]);
    if (begin == last) continue;
    if (w.instance != instance) start_instance(w, instance);
    while (begin < last) begin = first + make_some(w, begin - first, last - first, out);
  }
}

void SceneMaker::start_instance(Worker& w, std::size_t instance) {
  const Mesh& mesh = mesh_of(instance);
  const glm::dmat4 model = model_matrix(mesh, scene_->instances[instance]);
  const std::size_t first = first_ids_[instance];
  w.instance = instance;
  w.task.emplace(MeshTask{.options = *options_,
                          .mesh = mesh,
                          .view = view_->volume,
                          .to_screen = {*view_, model},
                          .depth = view_->depth,
                          .first_id = options_->first_id + static_cast<std::uint32_t>(first),
                          .states = states_ != nullptr ? states_ + first : nullptr});
  w.light.emplace(ShadeTask{mesh, cofactor_matrix(model), to_light_, w.task->first_id});
  w.sides.reset();
  if (!mesh.clusters.empty()) w.sides.emplace(w.task->to_screen, view_->volume);
  w.window.start(mesh);
}

SceneMaker::Sight SceneMaker::find_sight(Worker& w) {
  const std::atomic_ref sight(sights_[w.instance]);
  if (const auto known = sight.load(std::memory_order_relaxed); known != unknown)
    return static_cast<Sight>(known);
  constexpr std::size_t kGranules = 4;  // at once
  const std::size_t vertices = w.task->mesh.positions.size(),
                    granules = (vertices + VertexWindow::kGranule - 1) / VertexWindow::kGranule;
  std::uint32_t common = kInvisible | kNotFinite;  // of all vertices: the window is empty
  for (std::size_t i = 0; i < granules && (common & kInvisible) != 0; i += kGranules)
    common &= w.window.fill(*w.task, i, std::min(i + kGranules, granules), transform_);
  const Sight found = common == 0 || (common & kNotFinite) != 0 ? in_sight : out_of_sight;
  sight.store(found, std::memory_order_relaxed);
  return found;
}

std::size_t SceneMaker::make_some(Worker& w, std::size_t begin, std::size_t end, ChunkOutput& out) {
  const MeshTask& task = *w.task;
  const auto drop = [&](std::size_t to) {
    out.stats.whole_mesh += to - begin;
    if (task.states != nullptr)
      std::fill_n(task.states + begin, to - begin, TriangleState::outside_with_mesh);
    return to;
  };
  const auto& clusters = task.mesh.clusters;
  if (clusters.empty()) {
    if (find_sight(w) == out_of_sight) return drop(end);
    end = std::min(end, begin + kChunkTriangles);
  } else {
    const auto end_of = [](std::size_t cluster) { return (cluster + 1) * kClusterTriangles; };
    std::size_t cluster = begin / kClusterTriangles;
    if (w.sides->exclude(clusters[cluster])) return drop(std::min(end, end_of(cluster)));
    const std::atomic_ref sight(sights_[w.instance]);
    if (sight.load(std::memory_order_relaxed) == unknown) sight.store(in_sight, std::memory_order_relaxed);
    end = std::min(end, begin + kChunkTriangles);
    while (end_of(cluster) < end && !w.sides->exclude(clusters[cluster + 1])) ++cluster;
    end = std::min(end, end_of(cluster));
  }
  make_visible(w, begin, end, out);
  return end;
}

void SceneMaker::make_visible(Worker& w, std::size_t begin, std::size_t end, ChunkOutput& out) {
  const MeshTask& task = *w.task;
  const Mesh& mesh = task.mesh;
  const IndexRange range = index_range_(mesh, begin, end);
  if (range.last >= mesh.positions.size()) {
    vertex_missing_.store(true, std::memory_order_relaxed);
    return;
  }
  const std::size_t first = out.count;
  assemble_(task, begin, end, w.window.corners(task, begin, end, range, transform_), out);
  if (options_->payload == Payload::id) return;
  // Until here the payload is the id. Colours replace it.
  const std::span made(out.triangles + first, out.count - first);
  if (options_->shade) return shade_(*w.light, made);
  for (ScreenTriangle& t : made) t.payload = mesh.colours[t.payload - task.first_id];
}

void SceneMaker::finish() {
  TriangleMaker::finish();
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const Mesh& mesh = mesh_of(i);
    if (mesh.triangles.empty()) {  // no range has it
      start_instance(workers_[0], i);
      find_sight(workers_[0]);
    }
    stats_.meshes_culled += sights_[i] != in_sight;
    if (vertex_missing_ && sights_[i] == in_sight) check_vertices(mesh);
  }
}

}  // namespace edgewise

// The order of the steps, each of which has a file of its own: vertices (transform.cpp), triangles
// (assemble.cpp or stream.cpp, with one_by_one.cpp and clip.cpp for what is special), colours (shade.cpp),
// and their places (in_order.h).
#include "frontend/frontend.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

#include "frontend/assemble.h"
#include "frontend/in_order.h"
#include "frontend/shade.h"
#include "frontend/stream.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "raster/contract.h"
#include "raster/parallel.h"
#include "scale_limits.h"

namespace edgewise {

namespace {

constexpr Cull kCullModes[] = {Cull::none, Cull::back, Cull::front, Cull::both};

void check(const Mesh& mesh) {
  if (mesh.colours.size() != mesh.triangles.size())
    throw std::invalid_argument("a mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                                std::to_string(mesh.colours.size()) + " colours");
}

const Mesh& mesh_of(const Scene& scene, const Instance& instance) {
  if (instance.mesh >= scene.meshes.size())
    throw std::invalid_argument("an instance names mesh " + std::to_string(instance.mesh) + " of " +
                                std::to_string(scene.meshes.size()));
  return scene.meshes[instance.mesh];
}

[[noreturn]] void throw_missing_vertex(const Mesh& mesh) {
  const auto largest = [](glm::uvec3 t) { return std::max({t.x, t.y, t.z}); };
  const auto bad = std::find_if(mesh.triangles.begin(), mesh.triangles.end(),
                                [&](glm::uvec3 t) { return largest(t) >= mesh.positions.size(); });
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
  clipped_near += o.clipped_near, clipped_far += o.clipped_far, clipped_guard += o.clipped_guard;
  pieces += o.pieces, culled += o.culled, zero_area += o.zero_area, emitted += o.emitted;
  return *this;
}

struct Frontend::State {
  Buffer<Vertex> vertices;  // of one mesh
  InOrder order;
  Buffer<ScreenTriangle> screen;
  Buffer<UnsnappedTriangle> unsnapped;
  FrontendStats stats;
  FrontendOptions options;

  // True if the mesh lies beyond one side of the view as a whole; no side is known of one without a finite
  // vertex.
  bool transform_mesh(const MeshJob& job) {
    const TransformKernel transform = transform_kernel(options.target);
    const std::size_t count = job.mesh.positions.size(), runs = (count + kRun - 1) / kRun;
    std::atomic<std::uint32_t> common{kInvisible | kNotFinite};
    parallel_for(count < kWorthThreads ? 1 : options.threads, static_cast<int>(runs), [&](int i) {
      const std::size_t begin = static_cast<std::size_t>(i) * kRun;
      common &= transform(job, begin, std::min(count, begin + kRun));
    });
    return (common & kNotFinite) == 0 && common != 0;
  }

  // Copies a run's output to its place, if there is room: if not, the frame is run again with more.
  void place(const RunOutput& out, std::size_t at) {
    if (at + out.count > screen.capacity()) return;
    std::copy_n(out.triangles.data(), out.count, screen.data() + at);
    if (options.keep_unsnapped) std::copy_n(out.unsnapped.data(), out.count, unsnapped.data() + at);
  }

  void assemble_mesh(const MeshJob& job, const ShadeJob& light, std::uint32_t first_id) {
    const AssembleKernel assemble = assemble_kernel(options.target);
    const ShadeKernel shade = shade_kernel(options.target);
    std::atomic<bool> all_exist{true};
    const auto make = [&](std::size_t begin, std::size_t end, RunOutput& out) {
      if (!assemble(job, begin, end, out)) {
        all_exist = false;
        return;
      }
      ScreenTriangle* triangles = out.triangles.data();
      if (options.payload == Payload::id)
        std::for_each_n(triangles, out.count, [&](ScreenTriangle& t) { t.payload += first_id; });
      else if (options.shade)
        shade(light, out);
      else
        std::for_each_n(triangles, out.count,
                        [&](ScreenTriangle& t) { t.payload = job.mesh.colours[t.payload]; });
    };
    order.for_each_run(job.mesh.triangles.size(), make,
                       [&](const RunOutput& out, std::size_t at) { place(out, at); });
    if (!all_exist) throw_missing_vertex(job.mesh);
  }

  void run_scene(const Scene& scene) {
    const glm::dmat4 to_screen = screen_matrix(scene.camera, options.width, options.height);
    std::size_t first_id = 0;
    for (const auto& instance : scene.instances) {
      const Mesh& mesh = mesh_of(scene, instance);
      check(mesh);
      vertices.reserve(mesh.positions.size());
      const glm::mat4 model = model_matrix(instance);
      const MeshJob job{options, mesh, glm::mat4(to_screen * glm::dmat4(model)), vertices.data()};
      ++stats.meshes;
      stats.triangles += mesh.triangles.size();
      if (transform_mesh(job)) {
        ++stats.meshes_culled;
        stats.whole_mesh += mesh.triangles.size();
      } else {
        assemble_mesh(job, ShadeJob(mesh, model, scene.to_light), static_cast<std::uint32_t>(first_id));
      }
      first_id += mesh.triangles.size();
    }
  }

  void run_stream(const TriangleStream& stream) {
    const StreamKernel kernel = stream_kernel(options.target);
    const StreamJob job{options, stream};
    stats.triangles = stream.triangles.size();
    order.for_each_run(
        stream.triangles.size(),
        [&](std::size_t begin, std::size_t end, RunOutput& out) { kernel(job, begin, end, out); },
        [&](const RunOutput& out, std::size_t at) { place(out, at); });
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
    run_once(drawable, checked_count(submitted(drawable)));
    // More pieces of cut triangles than triangles that were dropped: rare, and for one frame only.
    if (order.total() > screen.capacity()) run_once(drawable, checked_count(order.total()));
  }
};

Frontend::Frontend() : state_(std::make_unique<State>()) {}
Frontend::~Frontend() = default;
Frontend::Frontend(Frontend&&) noexcept = default;
Frontend& Frontend::operator=(Frontend&&) noexcept = default;

std::span<const ScreenTriangle> Frontend::run(const Drawable& drawable, const FrontendOptions& options) {
  for (const int side : {options.width, options.height})
    if (side < 1 || side > contract::kMaxImageSide)
      throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                  std::to_string(contract::kMaxImageSide));
  if (options.threads > kMaxThreads)
    throw std::invalid_argument(std::to_string(options.threads) + " threads are more than " +
                                std::to_string(kMaxThreads));
  State& s = *state_;
  s.options = options;
  s.options.threads = std::max(options.threads, 1);
  s.options.target = resolve(options.target);
  s.run(drawable);
  return {s.screen.data(), s.order.total()};
}

const FrontendStats& Frontend::stats() const {
  return state_->stats;
}

std::span<const UnsnappedTriangle> Frontend::unsnapped() const {
  return {state_->unsnapped.data(), state_->options.keep_unsnapped ? state_->order.total() : 0};
}

}  // namespace edgewise

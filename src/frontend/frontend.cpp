// Runs the steps of the front end:
// - meshes: scene_maker.cpp. It transforms vertices (transform.cpp), assembles triangles (assemble.cpp) and
//   shades them (shade.cpp).
// - streams: stream.cpp
// - special cases of both: one_by_one.cpp, clip.cpp
// - output in the order of submission: in_order.h
#include "edgewise/frontend.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "core/execution.h"
#include "core/float_state.h"
#include "edgewise/contract.h"
#include "frontend/in_order.h"
#include "frontend/scene_maker.h"
#include "frontend/sources.h"
#include "frontend/submission.h"
#include "frontend/tasks.h"

namespace edgewise {

namespace {

constexpr Cull kCullModes[] = {Cull::none, Cull::back, Cull::front, Cull::both};

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

struct Frontend::State {
  SceneMaker maker;
  InOrder order;
  TriangleBuffers visible;
  std::size_t unsnapped_count = 0;  // valid ones
  Buffer<TriangleState> states;
  std::size_t state_count = 0;  // valid ones
  FrontendStats stats;
  FrontendOptions options;
  Execution execution;
  std::variant<std::monostate, StreamSource, SceneSource> source;

  // Throws std::invalid_argument.
  void set(const FrontendOptions& o, const Execution& e) {
    unsnapped_count = state_count = 0;
    for (const int side : {o.width, o.height})
      if (side < 1 || side > contract::kMaxImageSide)
        throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                    std::to_string(contract::kMaxImageSide));
    execution = checked(e);
    options = o;
  }

  // As many as have work.
  int workers_for(std::size_t count, std::size_t length) const {
    const auto threads = count < kWorthThreads ? 1 : static_cast<std::size_t>(execution.threads);
    return static_cast<int>(std::clamp((count + length - 1) / length, std::size_t{1}, threads));
  }

  // Calls make(worker, begin, end, output, ready) for ranges of `length` inputs; if there is one worker, for
  // all `count` at once, unless there are none.
  template <typename Make>
  void for_each_range(std::size_t count, std::size_t length, Make&& make) {
    const int workers = workers_for(count, length);
    order.start_frame(workers, workers > 1 ? length : 0, options.keep_unsnapped);
    if (workers == 1) length = std::max(count, std::size_t{1});
    order.for_each_range((count + length - 1) / length, workers, visible,
                         [&](int worker, std::size_t range, ChunkOutput& out, auto&& ready) {
                           const std::size_t begin = range * length;
                           make(worker, begin, std::min(count, begin + length), out, ready);
                         });
  }

  // Long ranges share few vertices. Short ones keep all workers busy until the end.
  std::size_t range_length(std::size_t count) const {
    constexpr std::size_t kLeast = kChunkTriangles, kMost = 32768;
    static_assert(InOrder::kBuffers * (kMost + ChunkOutput::kChunkRoom) * sizeof(ScreenTriangle) +
                      VertexWindow::kBytes <
                  8'000'000);  // as frontend.h promises for a thread
    static_assert(InOrder::kBuffers * (kMost + ChunkOutput::kChunkRoom) * sizeof(UnsnappedTriangle) <
                  6'000'000);
    return std::clamp(count / (16 * static_cast<std::size_t>(execution.threads)), kLeast, kMost);
  }

  void run_scene(const Scene& scene, std::size_t count) {
    const std::size_t length = range_length(count);
    maker.start_frame(scene, options, execution.target, options.keep_states ? states.data() : nullptr,
                      workers_for(count, length));
    for_each_range(count, length,
                   [&](int worker, std::size_t begin, std::size_t end, ChunkOutput& out, auto&& ready) {
                     maker.make(worker, begin, end, out, ready);
                   });
    maker.end_frame(stats);
  }

  void run_stream(const TriangleStream& stream) {
    const StreamKernel kernel = stream_kernel(execution.target);
    const StreamTask task{options, stream, options.keep_states ? states.data() : nullptr};
    const std::size_t count = stream.triangles.size();
    stats.triangles = count;
    for_each_range(count, range_length(count),
                   [&](int, std::size_t begin, std::size_t end, ChunkOutput& out, auto&& ready) {
                     for (; begin < end; begin += kChunkTriangles) {
                       ready();
                       kernel(task, begin, std::min(end, begin + kChunkTriangles), out);
                     }
                   });
  }

  void run_once(const Drawable& drawable, std::size_t count, std::size_t room) {
    visible.reserve(room + ChunkOutput::kChunkRoom, options.keep_unsnapped);
    stats = {};
    if (const auto* scene = std::get_if<Scene>(&drawable))
      run_scene(*scene, count);
    else
      run_stream(std::get<TriangleStream>(drawable));
    stats += order.stats();
  }

  std::uint32_t first_id() const { return options.payload == Payload::id ? options.first_id : 0; }

  void run(const Drawable& drawable) {
    const std::size_t count = checked_count(submitted(drawable), first_id());
    if (options.keep_states) states.reserve(count);
    run_once(drawable, count, count);
    // Clipping added more triangles than were dropped. This is rare, and the memory then suffices for the
    // next frames of the kind.
    if (order.total() + ChunkOutput::kChunkRoom > visible.screen.capacity())
      run_once(drawable, count, checked_count(order.total()));
    if (options.keep_unsnapped) unsnapped_count = order.total();
    if (options.keep_states) state_count = count;
  }
};

Frontend::Frontend() : state_(std::make_unique<State>()) {}
Frontend::~Frontend() = default;
Frontend::Frontend(Frontend&&) noexcept = default;
Frontend& Frontend::operator=(Frontend&&) noexcept = default;

ScreenTriangles Frontend::run(const Drawable& drawable, const FrontendOptions& options,
                              const Execution& execution) {
  const DefaultFloatState state;
  State& s = *state_;
  s.set(options, execution);
  s.run(drawable);
  return {{s.visible.screen.data(), s.order.total()}, options.width, options.height};
}

TriangleSource* Frontend::start_source(const Drawable& drawable, const FrontendOptions& options,
                                       const Execution& execution) {
  State& s = *state_;
  s.set(options, execution);
  if (options.keep_unsnapped || options.keep_states) return nullptr;
  s.stats = {};
  const std::size_t count = checked_count(submitted(drawable), s.first_id());
  s.order.start_frame(execution.threads, kChunkTriangles, false);
  if (const auto* stream = std::get_if<TriangleStream>(&drawable)) {
    s.stats.triangles = count;
    return &s.source.emplace<StreamSource>(s.options, s.execution.target, *stream, s.order);
  }
  s.maker.start_frame(std::get<Scene>(drawable), s.options, s.execution.target, nullptr, execution.threads);
  return &s.source.emplace<SceneSource>(s.maker, s.stats, count, s.order);
}

void Frontend::end_source() {
  state_->source.emplace<std::monostate>();
  state_->stats += state_->order.stats();
}

const FrontendStats& Frontend::stats() const {
  return state_->stats;
}

std::span<const UnsnappedTriangle> Frontend::unsnapped() const {
  return {state_->visible.unsnapped.data(), state_->unsnapped_count};
}

std::span<const TriangleState> Frontend::states() const {
  return {state_->states.data(), state_->state_count};
}

}  // namespace edgewise

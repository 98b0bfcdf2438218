// Runs the steps of the front end:
// - meshes: scene_maker.cpp. It transforms vertices (transform.cpp, vertex_window.h), assembles triangles
//   (assemble.cpp) and shades them (shade.cpp).
// - streams: stream.cpp
// - special cases of both: one_by_one.cpp, clip.cpp
#include "edgewise/frontend.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "core/execution.h"
#include "core/float_state.h"
#include "core/parallel.h"
#include "edgewise/contract.h"
#include "frontend/scene_checks.h"
#include "frontend/scene_maker.h"
#include "frontend/tasks.h"
#include "frontend/triangle_maker.h"

namespace edgewise {

std::span<const Cull> cull_modes() {
  static constexpr Cull kModes[] = {Cull::none, Cull::back, Cull::front, Cull::both};
  return kModes;
}

std::string_view name_of(Cull cull) {
  constexpr std::string_view kNames[] = {"none", "back", "front", "both"};
  const auto i = static_cast<std::size_t>(cull);
  if (i >= std::size(kNames)) throw std::invalid_argument("not a culling mode");
  return kNames[i];
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
  SceneMaker scene_maker;
  StreamMaker stream_maker;
  TriangleMaker* maker = nullptr;  // of the last frame
  TriangleBuffers visible;
  Buffer<TriangleState> states;
  std::vector<std::size_t> places;                   // of the workers' outputs in `visible`
  std::size_t unsnapped_count = 0, state_count = 0;  // valid ones
  FrontendStats stats;
  FrontendOptions options;
  Execution execution;

  // Throws std::invalid_argument.
  void set(const Drawable& drawable, const FrontendOptions& o, const Execution& e) {
    unsnapped_count = state_count = 0;
    for (const int side : {o.width, o.height})
      if (side < 1 || side > contract::kMaxImageSide)
        throw std::invalid_argument("image side " + std::to_string(side) + " is outside 1 to " +
                                    std::to_string(contract::kMaxImageSide));
    check_subpixel_bits(o.subpixel_bits);
    execution = checked(e);
    options = o;
    if (const auto* scene = std::get_if<Scene>(&drawable))
      scene_maker.set(*scene, options, execution.target), maker = &scene_maker;
    else
      stream_maker.set(std::get<TriangleStream>(drawable), options, execution.target), maker = &stream_maker;
    checked_count(maker->size(), options.payload == Payload::id ? options.first_id : 0);
  }

  // Makes all triangles, in order. Returns their number.
  std::size_t run() {
    // Long ranges share few vertices. Short ones keep all workers busy until the end.
    constexpr std::size_t kShortest = kChunkTriangles, kLongest = 16384;
    static_assert(ChunkOutput::room_for(kLongest) * sizeof(ScreenTriangle) + VertexWindow::kBytes <
                  8'000'000);  // as frontend.h promises for a thread
    static_assert(ChunkOutput::room_for(kLongest) * sizeof(UnsnappedTriangle) < 6'000'000);
    const std::size_t count = maker->size();
    const auto threads = static_cast<std::size_t>(count < kWorthThreads ? 1 : execution.threads);
    const std::size_t length =
        threads == 1 ? kLongest : std::clamp(count / (16 * threads), kShortest, kLongest);
    const std::size_t workers = std::clamp((count + length - 1) / length, std::size_t{1}, threads);
    if (options.keep_states) states.reserve(count);
    maker->start_workers(static_cast<int>(workers), workers == 1 ? 0 : length,
                         options.keep_states ? states.data() : nullptr);
    // Clipping rarely adds more triangles than are dropped.
    visible.reserve(count + ChunkOutput::room_for(length), options.keep_unsnapped);
    const std::size_t total = workers == 1 ? run_alone(length) : run_together(length, workers);
    maker->finish();
    stats = maker->stats();
    if (options.keep_unsnapped) unsnapped_count = total;
    if (options.keep_states) state_count = count;
    return total;
  }

  // Makes triangles where they stay.
  std::size_t run_alone(std::size_t length) {
    const std::size_t count = maker->size();
    ChunkOutput& out = maker->output(0);
    std::size_t total = 0;
    for (std::size_t begin = 0; begin < count; begin += length) {
      visible.grow(total, total + ChunkOutput::room_for(length), options.keep_unsnapped);
      out.write_to(visible, total);
      maker->append(0, begin, std::min(count, begin + length), out);
      total = checked_count(total + out.count);
    }
    return total;
  }

  // In each round, every worker copies what it made in the previous one to its place, and makes a range.
  std::size_t run_together(std::size_t length, std::size_t workers) {
    const std::size_t count = maker->size();
    places.assign(workers, 0);
    std::size_t total = 0;
    for (std::size_t round = 0;; round += workers * length) {
      parallel_for(static_cast<int>(workers), static_cast<int>(workers), [&](int worker) {
        const auto i = static_cast<std::size_t>(worker);
        const ChunkOutput& made = maker->output(worker);
        std::copy_n(made.triangles, made.count, visible.screen.data() + places[i]);
        if (options.keep_unsnapped)
          std::copy_n(made.unsnapped, made.count, visible.unsnapped.data() + places[i]);
        const std::size_t begin = std::min(count, round + i * length);
        maker->make(worker, begin, std::min(count, begin + length));
      });
      if (round >= count) return total;
      const std::size_t placed = total;
      for (std::size_t i = 0; i < workers; ++i) {
        places[i] = total;
        total = checked_count(total + maker->output(static_cast<int>(i)).count);
      }
      visible.grow(placed, total, options.keep_unsnapped);
    }
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
  s.set(drawable, options, execution);
  const std::size_t total = s.run();
  return {{s.visible.screen.data(), total}, options.width, options.height};
}

TriangleSource* Frontend::start_source(const Drawable& drawable, const FrontendOptions& options,
                                       const Execution& execution) {
  state_->set(drawable, options, execution);
  if (options.keep_unsnapped || options.keep_states) return nullptr;
  state_->maker->start_workers(execution.threads, TriangleSource::kInputsAtOnce, nullptr);
  return state_->maker;
}

void Frontend::end_source() {
  state_->stats = state_->maker->stats();
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

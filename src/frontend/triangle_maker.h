// What makes the screen triangles of a drawable: of a stream here, of a scene in scene_maker.h.
// Frontend::run() collects them. For draw(), a backend makes them where it needs them
// (core/triangle_source.h).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/triangle_source.h"
#include "frontend/scene_checks.h"
#include "frontend/tasks.h"

namespace edgewise {

class TriangleMaker : public TriangleSource {
 public:
  // For make() by so many workers, of up to `inputs` at once. `states` holds one per input, to be written, or
  // is null.
  virtual void start_workers(int workers, std::size_t inputs, TriangleState* states) {
    if (outputs_.size() < static_cast<std::size_t>(workers))
      outputs_ = std::vector<Worker>(static_cast<std::size_t>(workers));
    for (Worker& worker : outputs_) {
      worker.buffers.reserve(ChunkOutput::room_for(inputs), options_->keep_unsnapped);
      worker.out.count = 0, worker.out.stats = {};
    }
    stats_ = {.triangles = size()};
    states_ = states;
  }
  // Appends the screen triangles of inputs begin … end - 1 to `out`, which has room for them. Calls with
  // different workers may run at once. Does not throw.
  virtual void append(int worker, std::size_t begin, std::size_t end, ChunkOutput& out) = 0;

  // Makes them in the worker's own output.
  std::span<const ScreenTriangle> make(int worker, std::size_t begin, std::size_t end) final {
    ChunkOutput& out = output(worker);
    out.write_to(outputs_[static_cast<std::size_t>(worker)].buffers, 0);
    append(worker, begin, end, out);
    return {out.triangles, out.count};
  }
  // Also throws std::invalid_argument if clipping made too many triangles.
  void finish() override { checked_count(stats().emitted); }
  ChunkOutput& output(int worker) { return outputs_[static_cast<std::size_t>(worker)].out; }

  FrontendStats stats() const {
    FrontendStats sum = stats_;
    for (const Worker& worker : outputs_) sum += worker.out.stats;
    return sum;
  }

 protected:
  const FrontendOptions* options_ = nullptr;
  TriangleState* states_ = nullptr;
  FrontendStats stats_;  // what the workers' outputs do not count

 private:
  struct Worker {
    TriangleBuffers buffers;
    ChunkOutput out;
  };
  std::vector<Worker> outputs_;
};

class StreamMaker final : public TriangleMaker {
 public:
  // The arguments must outlive the frame. Throws as Frontend::run() does.
  void set(const TriangleStream& stream, const FrontendOptions& options, SimdTarget target) {
    check(stream);
    stream_ = &stream, options_ = &options, kernel_ = stream_kernel(target);
  }
  std::size_t size() const override { return stream_->size(); }
  void append(int, std::size_t begin, std::size_t end, ChunkOutput& out) override {
    kernel_({*options_, *stream_, states_}, begin, end, out);
  }

 private:
  const TriangleStream* stream_ = nullptr;
  StreamKernel kernel_ = nullptr;
};

}  // namespace edgewise

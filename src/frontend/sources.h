// Make the screen triangles of a drawable where a backend needs them (core/triangle_source.h).
#pragma once

#include <cstddef>
#include <span>

#include "core/triangle_source.h"
#include "frontend/in_order.h"
#include "frontend/scene_maker.h"
#include "frontend/tasks.h"

namespace edgewise {

class StreamSource final : public TriangleSource {
 public:
  StreamSource(const FrontendOptions& options, SimdTarget target, const TriangleStream& stream,
               InOrder& order)
      : task_{options, stream}, kernel_(stream_kernel(target)), order_(order) {}
  std::size_t size() const override { return task_.stream.triangles.size(); }
  std::span<const ScreenTriangle> make(int worker, std::size_t begin, std::size_t end) override {
    ChunkOutput& out = order_.output(worker);
    kernel_(task_, begin, end, out);
    return {out.triangles, out.count};
  }

 private:
  StreamTask task_;
  StreamKernel kernel_;
  InOrder& order_;
};

class SceneSource final : public TriangleSource {
 public:
  SceneSource(SceneMaker& maker, FrontendStats& stats, std::size_t count, InOrder& order)
      : maker_(maker), stats_(stats), count_(count), order_(order) {}
  std::size_t size() const override { return count_; }
  std::span<const ScreenTriangle> make(int worker, std::size_t begin, std::size_t end) override {
    ChunkOutput& out = order_.output(worker);
    maker_.make(worker, begin, end, out, [] {});
    return {out.triangles, out.count};
  }
  void finish() override { maker_.end_frame(stats_); }

 private:
  SceneMaker& maker_;
  FrontendStats& stats_;
  std::size_t count_;
  InOrder& order_;
};
static_assert(TriangleSource::kInputsAtOnce <= kChunkTriangles);  // the output has room for any

}  // namespace edgewise

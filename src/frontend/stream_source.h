// Makes the screen triangles of a stream where a backend needs them (core/triangle_source.h).
#pragma once

#include <cstddef>
#include <span>

#include "core/triangle_source.h"
#include "frontend/in_order.h"
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
  std::span<const ScreenTriangle> probe(std::size_t input) override {
    FrontendStats& stats = order_.output(0).stats;
    const FrontendStats before = stats;
    const auto triangles = make(0, input, input + 1);
    stats = before;
    return triangles;
  }

 private:
  StreamTask task_;
  StreamKernel kernel_;
  InOrder& order_;
};
static_assert(TriangleSource::kInputsAtOnce <= kChunkTriangles);

}  // namespace edgewise

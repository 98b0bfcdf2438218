// What the steps of the front end hand each other: the job, the same for all runs of a mesh or stream, and
// the output of one run of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/buffer.h"
#include "edgewise/frontend.h"
#include "frontend/vertex.h"

namespace edgewise {

struct MeshTask {
  const FrontendOptions& options;
  const Mesh& mesh;
  glm::mat4 to_screen;              // model space → pixels and depth, both times w
  Vertex* vertices;                 // one a position
  TriangleState* states = nullptr;  // one a triangle, to be set; null: not wanted

  // What is asked for of each triangle alone.
  bool one_by_one() const { return options.keep_unsnapped || states != nullptr; }
};

struct StreamTask {
  const FrontendOptions& options;
  const TriangleStream& stream;
  TriangleState* states = nullptr;  // as above

  bool one_by_one() const { return options.keep_unsnapped || states != nullptr; }
};

// Work is cut into runs of this many vertices or triangles, whatever the thread count: small enough that a
// run's output waits in the L2 cache for its turn.
inline constexpr std::size_t kRun = 2048;

// Below this many, waking another thread costs more than it saves.
inline constexpr std::size_t kWorthThreads = 8192;

inline int workers_for(std::size_t count, int threads) {
  return count < kWorthThreads ? 1 : threads;
}

// A run's visible triangles. Every worker has one and fills it again for each of its runs; two workers' share
// no cache line, nor the pair of lines that processors fetch.
struct alignas(128) RunOutput {
  // A triangle cut by six planes has nine corners, so it becomes seven at most; vectors are stored whole.
  static constexpr std::size_t kRoom = kRun * 7 + 16;
  static_assert(kRoom * std::max(sizeof(ScreenTriangle), sizeof(UnsnappedTriangle)) < 1'000'000);

  void reserve(bool with_unsnapped) {
    triangles.reserve(kRoom);
    if (with_unsnapped) unsnapped.reserve(kRoom);
  }

  Buffer<ScreenTriangle> triangles;
  Buffer<UnsnappedTriangle> unsnapped;  // used with keep_unsnapped
  std::size_t count = 0;
  FrontendStats stats;  // of all its runs together
};

}  // namespace edgewise

// The input and output of the front end's steps: a task, which is the same for all chunks of a mesh or
// stream, and the output of one chunk.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/buffer.h"
#include "edgewise/frontend.h"
#include "frontend/mesh_clusters.h"
#include "frontend/vertex.h"
#include "frontend/view.h"

namespace edgewise {

struct MeshTask {
  const FrontendOptions& options;
  const Mesh& mesh;
  ViewVolume view;
  ScreenTransform to_screen;        // model space → pixels times w, and w
  ViewDepth depth;                  // w → contract units
  Vertex* vertices;                 // by the mesh's indices
  VertexRange vertex_range{};       // of those in `vertices`
  std::uint32_t first_id = 0;       // of the mesh's triangles
  TriangleState* states = nullptr;  // one per triangle, to be written; null: not needed

  // True if add_one() must handle every triangle.
  bool one_by_one() const { return options.keep_unsnapped || states != nullptr; }
};

struct StreamTask {
  const FrontendOptions& options;
  const TriangleStream& stream;
  TriangleState* states = nullptr;  // as in MeshTask

  bool one_by_one() const { return options.keep_unsnapped || states != nullptr; }
};

// The vertices or triangles of a chunk, whatever the thread count. Small enough that a chunk's output stays
// in the L2 cache until it is copied.
inline constexpr std::size_t kChunkTriangles = 2048;

// Below this many vertices or triangles, waking another thread costs more than it saves.
inline constexpr std::size_t kWorthThreads = 8192;

inline int workers_for(std::size_t count, int threads) {
  return count < kWorthThreads ? 1 : threads;
}

// A chunk's visible triangles. Assembly writes ids as the payloads of a mesh's triangles. For
// Payload::colour, colours then replace the ids. Each worker has one output and reuses it for all its chunks.
// The alignment keeps two workers' outputs out of the same pair of cache lines, which processors fetch
// together.
struct alignas(128) ChunkOutput {
  // A triangle clipped by six planes has at most nine vertices, so it becomes at most seven triangles. The
  // last vector is stored whole.
  static constexpr std::size_t kCapacity = kChunkTriangles * 7 + 16;
  static_assert(kCapacity * std::max(sizeof(ScreenTriangle), sizeof(UnsnappedTriangle)) < 1'000'000);

  void reserve(bool with_unsnapped) {
    triangles.reserve(kCapacity);
    if (with_unsnapped) unsnapped.reserve(kCapacity);
  }

  Buffer<ScreenTriangle> triangles;
  Buffer<UnsnappedTriangle> unsnapped;  // with keep_unsnapped only
  std::size_t count = 0;
  FrontendStats stats;  // the sum over all its chunks of the frame
};

}  // namespace edgewise

// The front end's steps: their input, which is the same for all chunks of a mesh or stream, the output of one
// chunk, and the kernels that make triangles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/buffer.h"
#include "edgewise/frontend.h"
#include "edgewise/simd_target.h"
#include "frontend/clip.h"
#include "frontend/mesh_clusters.h"
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

// Appends the visible pieces of triangles begin … end - 1 to the output, with ids as payloads: task.first_id
// plus the triangle's index in the mesh. Returns false and appends nothing if a triangle names a vertex that
// is not `allowed`.
using AssembleKernel = bool (*)(const MeshTask& task, std::size_t begin, std::size_t end, VertexRange allowed,
                                ChunkOutput& out);

// `target` must be resolved.
AssembleKernel assemble_kernel(SimdTarget target);

// Appends the visible pieces of triangles begin … end - 1 to the output, with the payload that the options
// select.
using StreamKernel = void (*)(const StreamTask& task, std::size_t begin, std::size_t end, ChunkOutput& out);

// `target` must be resolved.
StreamKernel stream_kernel(SimdTarget target);

// one_by_one.cpp handles a single triangle in any condition. The kernels process the common case in vectors
// and call add_one() for the rest:
// - all triangles of a vector in which one needs clipping or is not finite,
// - the last triangles of a chunk, too few for a vector,
// - every triangle with keep_unsnapped or keep_states.
//
// Appends the visible pieces of a triangle to the output and counts them in its statistics. A mesh triangle's
// payload is its id, task.first_id plus its index in the mesh; a stream triangle's is the one that the
// options select.
void add_one(const MeshTask& task, std::size_t triangle, ChunkOutput& out);
void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out);

}  // namespace edgewise

// The front end's steps: their input, which is the same for all triangles of a mesh or stream, their output,
// and the kernels that make triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "core/buffer.h"
#include "core/triangle_source.h"
#include "edgewise/frontend.h"
#include "edgewise/simd_target.h"
#include "frontend/clip.h"
#include "frontend/fixed.h"
#include "frontend/view.h"

namespace edgewise {

struct MeshTask {
  const FrontendOptions& options;
  const Mesh& mesh;
  ViewVolume view;
  ScreenTransform to_screen;        // model space → pixels times w, and w
  ViewDepth depth;                  // w → contract units
  std::uint32_t first_id = 0;       // of the mesh's triangles
  TriangleState* states = nullptr;  // one per triangle, to be written; null: not needed

  // True if add_one() must handle every triangle.
  bool one_by_one() const { return options.keep_unsnapped || states != nullptr; }
  bool is_fine() const { return edgewise::is_fine(options.subpixel_bits); }
};

struct StreamTask {
  const FrontendOptions& options;
  const TriangleStream& stream;
  TriangleState* states = nullptr;  // as in MeshTask

  bool one_by_one() const { return options.keep_unsnapped || states != nullptr || !stream.exact.empty(); }
};

// Triangles that are made together: their output stays in the L2 cache until it is shaded, or binned.
inline constexpr std::size_t kChunkTriangles = TriangleSource::kInputsAtOnce;

// Below this many triangles, waking another thread costs more than it saves.
inline constexpr std::size_t kWorthThreads = 8192;

// For rule 11: the z and w that a vertex' snapped position was made from, and the weights of the source
// triangle's vertices in it.
struct SourceVertex {
  double z, w;
  std::array<double, 3> weights;
};

struct TriangleBuffers {
  void reserve(std::size_t count, bool with_unsnapped) {
    screen.reserve(count);
    if (with_unsnapped) unsnapped.reserve(screen.capacity());
  }
  // Makes room for `count` records, and keeps the first `used`.
  void grow(std::size_t used, std::size_t count, bool with_unsnapped) {
    if (count <= screen.capacity()) return;
    TriangleBuffers larger;
    larger.reserve(std::max(count, 2 * screen.capacity()), with_unsnapped);
    std::copy_n(screen.data(), used, larger.screen.data());
    if (with_unsnapped) std::copy_n(unsnapped.data(), used, larger.unsnapped.data());
    *this = std::move(larger);
  }

  Buffer<ScreenTriangle> screen;
  Buffer<UnsnappedTriangle> unsnapped;  // with keep_unsnapped only
};

// Visible triangles of consecutive submitted ones. Assembly writes ids as the payloads of a mesh's triangles.
// For Payload::colour, colours then replace the ids. Aligned, so that two workers' outputs share no
// cache line.
struct alignas(64) ChunkOutput {
  // For the screen triangles of so many inputs. A triangle clipped by six planes has at most nine vertices,
  // so it becomes at most seven triangles. The last vector is stored whole.
  static constexpr std::size_t room_for(std::size_t inputs) { return inputs * 7 + 16; }

  // Empties the output, and continues in `buffers` from record `at` on.
  void write_to(TriangleBuffers& buffers, std::size_t at) {
    triangles = buffers.screen.data() + at;
    const bool has_unsnapped = buffers.unsnapped.capacity() >= buffers.screen.capacity();
    unsnapped = has_unsnapped ? buffers.unsnapped.data() + at : nullptr;
    count = 0;
  }

  ScreenTriangle* triangles = nullptr;
  UnsnappedTriangle* unsnapped = nullptr;                       // with keep_unsnapped only
  std::vector<std::array<SourceVertex, 3>>* sources = nullptr;  // unless null, add_one() appends to it
  std::size_t count = 0;
  // The sum over all that its worker made into it in the frame. Aligned, because streams are made faster so
  // (frontend/medium on one thread of a Zen 3).
  alignas(64) FrontendStats stats;
};

struct IndexRange {
  std::uint32_t first, last;
};

// The least and the greatest vertex that triangles begin … end - 1 of the mesh name, at least one triangle.
using IndexRangeKernel = IndexRange (*)(const Mesh& mesh, std::size_t begin, std::size_t end);

// The transformed vertices of consecutive triangles, whose indices lie in a range of at most kVertices.
struct Corners {
  static constexpr std::uint32_t kVertices = 1 << 16;  // a power of two

  const Vertex* vertices;
  const glm::uvec3* indices;  // by triangle

  const Vertex* at(std::uint32_t index) const { return vertices + (index & (kVertices - 1)); }
};

// Appends the visible pieces of triangles begin … end - 1 to the output, with ids as payloads: task.first_id
// plus the triangle's index in the mesh. Corners have index 0 for triangle `begin`.
using AssembleKernel = void (*)(const MeshTask& task, std::size_t begin, std::size_t end,
                                const Corners& corners, ChunkOutput& out);

// Appends the visible pieces of triangles begin … end - 1 to the output, with the payload that the options
// select.
using StreamKernel = void (*)(const StreamTask& task, std::size_t begin, std::size_t end, ChunkOutput& out);

// `target` must be resolved.
IndexRangeKernel index_range_kernel(SimdTarget target);
AssembleKernel assemble_kernel(SimdTarget target);
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
void add_one(const MeshTask& task, std::size_t triangle, const Vertex (&corners)[3], ChunkOutput& out);
void add_one(const StreamTask& task, std::size_t triangle, ChunkOutput& out);

}  // namespace edgewise

// Cuts a large mesh into runs of triangles whose vertices lie close together in memory. The front end
// transforms and assembles one run after the other, so that triangles find their vertices in the L2 cache.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "edgewise/scene.h"
#include "edgewise/simd_target.h"

namespace edgewise {

struct IndexRange {
  std::uint32_t first, last;

  std::size_t size() const { return std::size_t{last} - first + 1; }
  IndexRange with(IndexRange o) const { return {std::min(first, o.first), std::max(last, o.last)}; }
};

// Triangles first_triangle … end_triangle - 1 of a mesh, and the vertices that hold all which they name.
struct MeshRun {
  std::size_t first_triangle, end_triangle, first_vertex, end_vertex;

  std::size_t triangles() const { return end_triangle - first_triangle; }
  std::size_t vertices() const { return end_vertex - first_vertex; }
};

class MeshRuns {
 public:
  // Of at most kMaxVertices vertices each, unless a single triangle names vertices further apart. The whole
  // mesh is one run if it has no more, if its triangles are in no such order, or if one names a missing
  // vertex. Valid until the next call. `target` must be resolved.
  std::span<const MeshRun> cut(const Mesh& mesh, int threads, SimdTarget target);

  static constexpr std::size_t kMaxVertices = 49152;  // their transformed records take 768 KB

 private:
  std::vector<IndexRange> ranges_;  // of the mesh's chunks
  std::vector<MeshRun> runs_;
};

}  // namespace edgewise

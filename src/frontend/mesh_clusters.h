// Cuts a large mesh into clusters: consecutive triangles whose vertices lie close together in memory. The
// front end transforms and assembles one cluster after the other, so that triangles find their vertices in
// the L2 cache, and drops clusters outside the view.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/llc.h"
#include "edgewise/scene.h"
#include "edgewise/simd_target.h"
#include "frontend/vertex.h"

namespace edgewise {

struct IndexRange {
  std::uint32_t first, last;

  std::size_t size() const { return std::size_t{last} - first + 1; }
  IndexRange with(IndexRange o) const { return {std::min(first, o.first), std::max(last, o.last)}; }
};

// Triangles first_triangle … end_triangle - 1 of a mesh, and a range that contains all their vertices.
struct MeshCluster {
  std::size_t first_triangle, end_triangle, first_vertex, end_vertex;

  std::size_t triangles() const { return end_triangle - first_triangle; }
  std::size_t vertices() const { return end_vertex - first_vertex; }
};

class MeshClusters {
 public:
  // Clusters of at most kMaxVertices vertices; a single triangle may name vertices further apart. A mesh
  // stays whole if
  // - it has at most kMaxVertices vertices,
  // - its triangles name vertices in random order,
  // - a triangle names a missing vertex; so all vertices of several clusters exist.
  // Valid until the next call. `target` must be resolved.
  std::span<const MeshCluster> cut(const Mesh& mesh, int threads, SimdTarget target);

  static constexpr std::size_t kMaxVertices = kL2Bytes / 4 * 3 / sizeof(Vertex);

 private:
  std::vector<IndexRange> ranges_;  // of the mesh's chunks
  std::vector<MeshCluster> clusters_;
};

}  // namespace edgewise

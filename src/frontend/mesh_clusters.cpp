// Finds the range of vertices of each chunk of triangles in parallel, and then joins consecutive chunks.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/mesh_clusters.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/index_range-inl.h"

#include "core/kernel_table.h"
#include "core/parallel.h"
#include "frontend/mesh_clusters.h"
#include "frontend/tasks.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

IndexRange range_of_chunk(const Mesh& mesh, std::size_t begin, std::size_t end) {
  return index_range(mesh, begin, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

std::span<const MeshCluster> MeshClusters::cut(const Mesh& mesh, int threads, SimdTarget target) {
  const std::size_t count = mesh.triangles.size(), vertices = mesh.positions.size();
  const auto whole = [&] {
    clusters_.assign(1, {0, count, 0, vertices});
    return std::span<const MeshCluster>(clusters_);
  };
  if (vertices <= kMaxVertices || count == 0) return whole();
  const auto range_of = EDGEWISE_KERNEL(range_of_chunk, target);
  ranges_.resize((count + kChunkTriangles - 1) / kChunkTriangles);
  parallel_for(workers_for(count, threads), static_cast<int>(ranges_.size()), [&](int i) {
    const std::size_t begin = static_cast<std::size_t>(i) * kChunkTriangles;
    ranges_[static_cast<std::size_t>(i)] = range_of(mesh, begin, std::min(count, begin + kChunkTriangles));
  });
  clusters_.clear();
  constexpr IndexRange kNone{~0u, 0};
  IndexRange range = kNone;
  std::size_t begin = 0;
  const auto end_cluster = [&](std::size_t end) {
    clusters_.push_back({begin, end, range.first, std::size_t{range.last} + 1});
    begin = end;
    range = kNone;
  };
  // In random order, clusters share most vertices, or are tiny. Up to twice as many as the vertices fill
  // still gain: transforming a vertex twice costs less than fetching it from memory once.
  const auto gains_nothing = [&] { return clusters_.size() > 2 * (vertices / kMaxVertices + 1); };
  const auto fits = [&](IndexRange next) { return range.with(next).size() <= kMaxVertices; };
  for (std::size_t chunk = 0; chunk < ranges_.size(); ++chunk) {
    if (ranges_[chunk].last >= vertices || gains_nothing()) return whole();
    if (fits(ranges_[chunk])) {
      range = range.with(ranges_[chunk]);
      continue;
    }
    // Two clusters meet in this chunk, or its triangles are in random order.
    const std::size_t first = chunk * kChunkTriangles;
    for (std::size_t i = first; i < std::min(count, first + kChunkTriangles); ++i) {
      const glm::uvec3 t = mesh.triangles[i];
      const IndexRange next{std::min({t.x, t.y, t.z}), std::max({t.x, t.y, t.z})};
      if (i > begin && !fits(next)) end_cluster(i);
      range = range.with(next);
    }
  }
  end_cluster(count);
  if (gains_nothing()) return whole();
  return clusters_;
}

}  // namespace edgewise
#endif

// Selects the clusters of a large mesh (Mesh::clusters) that may be in view, and joins them into parts whose
// vertices fit the L2 cache. The front end processes one part after the other, and only the vertices that the
// part's triangles name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/llc.h"
#include "edgewise/scene.h"
#include "frontend/vertex.h"

namespace edgewise {

// Indices first … end - 1.
struct VertexRange {
  std::size_t first, end;

  std::size_t size() const { return end - first; }
  bool contains(VertexRange o) const { return first <= o.first && o.end <= end; }
  bool overlaps(VertexRange o) const { return first < o.end && o.first < end; }
  VertexRange with(VertexRange o) const { return {std::min(first, o.first), std::max(end, o.end)}; }
};

inline VertexRange vertices_of(const MeshCluster& cluster) {
  return {cluster.first_vertex, cluster.end_vertex};
}

// The first triangle of a cluster, and the number of its triangles.
struct ClusterTriangles {
  std::size_t first, count;
};
inline ClusterTriangles triangles_of(const Mesh& mesh, std::size_t cluster) {
  const std::size_t first = cluster * kClusterTriangles;
  return {first, std::min(kClusterTriangles, mesh.triangles.size() - first)};
}

// The six sides of the view, in a mesh's model space.
class ViewSides {
 public:
  // `to_screen`: as in MeshTask.
  ViewSides(const glm::mat4& to_screen, int width_px, int height_px);
  // True if all vertices in the box are beyond one side. Then transform.cpp, whose floats are rounded, finds
  // them there too. False for a box that is not finite.
  bool exclude(const MeshCluster& box) const;

 private:
  // x, y, z, 1: a vertex v is beyond the side if plane · v < 0. The rounding errors of transform.cpp are less
  // than error · |v|.
  struct Side {
    glm::dvec4 plane, error;
  };
  Side sides_[6];
};

class ClusterPart {
 public:
  // A part has at most this many vertices, unless a single cluster has more.
  static constexpr std::size_t kMaxVertices = kL2Bytes / 4 * 3 / sizeof(Vertex);

  // Replaces the contents by clusters from index `next` on, for which is_excluded(index) is false. Returns
  // the first index that was not looked at. Throws std::invalid_argument if a cluster names a vertex that the
  // mesh lacks.
  template <typename IsExcluded>
  std::size_t take(const Mesh& mesh, std::span<const MeshCluster> clusters, std::size_t next,
                   IsExcluded&& is_excluded) {
    clusters_.clear();
    for (; next < clusters.size(); ++next) {
      if (is_excluded(next)) continue;
      const VertexRange more = checked_vertices(mesh, clusters[next]);
      const VertexRange both = clusters_.empty() ? more : range_.with(more);
      if (!clusters_.empty() && both.size() > kMaxVertices) break;
      range_ = both;
      clusters_.push_back(next);
    }
    if (!clusters_.empty()) mark_vertices(mesh, clusters);
    return next;
  }
  std::span<const std::size_t> clusters() const { return clusters_; }
  VertexRange range() const { return range_; }  // of all its vertices; invalid without clusters
  // Calls visit(first, count, range) for runs of its triangles, in order. All vertices of the range are
  // marked, or all that the triangles name.
  template <typename Visit>
  void for_each_triangle_run(const Mesh& mesh, Visit&& visit) const {
    for (std::size_t i = 0; i < clusters_.size();) {
      const std::size_t begin = i;
      VertexRange range = vertices_of(mesh.clusters[clusters_[i]]);
      for (++i; i < clusters_.size() && clusters_[i] == clusters_[i - 1] + 1; ++i) {
        const VertexRange more = vertices_of(mesh.clusters[clusters_[i]]);
        if (!range.overlaps(more) || is_wide(range) || is_wide(more)) break;
        range = range.with(more);
      }
      const ClusterTriangles last = triangles_of(mesh, clusters_[i - 1]);
      const std::size_t first = clusters_[begin] * kClusterTriangles;
      visit(first, last.first + last.count - first, range);
    }
  }
  // Calls visit(first, count) for runs of marked vertices, in order: those that triangles may name.
  template <typename Visit>
  void for_each_vertex_run(Visit&& visit) const {
    for (std::size_t begin = 0, end; begin < blocks_.size(); begin = end + 1) {
      end = begin;
      while (end < blocks_.size() && blocks_[end] != 0) ++end;
      if (end == begin) continue;
      const std::size_t first = range_.first + begin * kBlock;
      visit(first, std::min(range_.first + end * kBlock, range_.end) - first);
    }
  }

 private:
  static constexpr std::size_t kBlock = 64;  // vertices

  // True if two parts of the mesh meet in a cluster, or it names vertices in random order.
  static bool is_wide(VertexRange range) { return range.size() > kMaxVertices; }
  static VertexRange checked_vertices(const Mesh& mesh, const MeshCluster& cluster);
  void mark_vertices(const Mesh& mesh, std::span<const MeshCluster> clusters);

  std::vector<std::size_t> clusters_;
  VertexRange range_{};
  std::vector<std::uint8_t> blocks_;  // nonzero: triangles may name a vertex of this block of range_
};

}  // namespace edgewise

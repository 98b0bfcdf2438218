// Clusters of a mesh (Mesh::clusters), and how the front end uses them:
// - View-frustum culling: a cluster whose bounding box lies beyond one side of the view is dropped.
// - The others are joined into parts whose vertices fit the L2 cache, and processed part by part.
// - Only the vertices that a part's triangles may name are transformed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/llc.h"
#include "edgewise/scene.h"
#include "frontend/clip.h"
#include "frontend/view.h"

namespace edgewise {

// Indices first … end - 1.
struct VertexRange {
  std::size_t first, end;

  std::size_t size() const { return end - first; }
  bool contains(VertexRange o) const { return first <= o.first && o.end <= end; }
  bool touches(VertexRange o) const { return first <= o.end && o.first <= end; }
  VertexRange with(VertexRange o) const { return {std::min(first, o.first), std::max(end, o.end)}; }
};

inline VertexRange vertices_of(const MeshCluster& cluster) {
  return {cluster.first_vertex, cluster.end_vertex};
}

inline std::size_t cluster_count(const Mesh& mesh) {
  return (mesh.triangles.size() + kClusterTriangles - 1) / kClusterTriangles;
}

// The first triangle of a cluster, and the number of its triangles.
struct ClusterTriangles {
  std::size_t first, count;
};
inline ClusterTriangles triangles_of(const Mesh& mesh, std::size_t cluster) {
  const std::size_t first = cluster * kClusterTriangles;
  return {first, std::min(kClusterTriangles, mesh.triangles.size() - first)};
}

// The clusters of a mesh of any size, all of whose vertices must exist.
std::vector<MeshCluster> make_clusters(const Mesh& mesh);
// Sets the clusters of every mesh of a scene, whatever its size. For `verify --random` and fuzzing.
void make_clusters(Drawable& drawable);

// The six sides of the view, in a mesh's model space.
class ViewSides {
 public:
  ViewSides(const ScreenTransform& to_screen, const ViewVolume& view);
  // True only if all vertices in the box are beyond one side, and transform.cpp, which rounds to floats,
  // finds them there too. False for a box that is not finite.
  bool exclude(const MeshCluster& box) const;

 private:
  // With v = (position - origin, 1), a vertex is beyond the side if plane · v < 0. The rounding errors of
  // transform.cpp are less than the product of `error` and v's absolute coordinates.
  struct Side {
    glm::dvec4 plane, error;
  };
  glm::dvec3 origin_;
  Side sides_[6];
};

class ClusterPart {
 public:
  // A part has at most this many vertices, unless a single cluster has more.
  static constexpr std::size_t kMaxVertices = kL2Bytes / 4 * 3 / sizeof(Vertex);
  static constexpr std::size_t kGranule = 64;  // vertices, which are marked together

  // Takes parts of this mesh from now on. Both must outlive the parts.
  void start(const Mesh& mesh, std::span<const MeshCluster> clusters) {
    mesh_ = &mesh;
    all_ = clusters;
    next_ = 0;
    clusters_.reserve(clusters.size());
    granules_.reserve(mesh.positions.size() / kGranule + 1);
  }
  // Replaces the contents by the next clusters for which is_excluded(index) is false. Calls it once for each
  // excluded cluster, and at most twice for any other. Returns false if no cluster is left. Throws
  // std::invalid_argument if a cluster names a vertex that the mesh lacks.
  template <typename IsExcluded>
  bool take(IsExcluded&& is_excluded) {
    clusters_.clear();
    for (; next_ < all_.size(); ++next_) {
      if (is_excluded(next_)) continue;
      const VertexRange more = checked_vertices(next_);
      const VertexRange both = clusters_.empty() ? more : range_.with(more);
      if (!clusters_.empty() && both.size() > kMaxVertices) break;
      range_ = both;
      clusters_.push_back(next_);
    }
    if (clusters_.empty()) return false;
    mark_vertices();
    return true;
  }
  VertexRange range() const { return range_; }  // of all its vertices
  // Calls visit(first, count, range) for ranges of its triangles, in order. All vertices of the range are
  // marked, except for a cluster of more than kMaxVertices. That is a part of its own, and only the vertices
  // that its triangles name are marked.
  template <typename Visit>
  void for_each_triangle_range(Visit&& visit) const {
    for (std::size_t i = 0; i < clusters_.size();) {
      const std::size_t begin = i;
      VertexRange range = vertices_of(all_[clusters_[i]]);
      for (++i; i < clusters_.size() && clusters_[i] == clusters_[i - 1] + 1; ++i) {
        const VertexRange more = vertices_of(all_[clusters_[i]]);
        if (!range.touches(more)) break;
        range = range.with(more);
      }
      const ClusterTriangles last = triangles_of(*mesh_, clusters_[i - 1]);
      const std::size_t first = clusters_[begin] * kClusterTriangles;
      visit(first, last.first + last.count - first, range);
    }
  }
  // Calls visit(first, count) for ranges of marked vertices, in order: those that triangles may name.
  template <typename Visit>
  void for_each_vertex_range(Visit&& visit) const {
    for (std::size_t begin = 0, end; begin < granules_.size(); begin = end + 1) {
      end = begin;
      while (end < granules_.size() && granules_[end] != 0) ++end;
      if (end == begin) continue;
      const std::size_t first = range_.first + begin * kGranule;
      visit(first, std::min(range_.first + end * kGranule, range_.end) - first);
    }
  }

 private:
  VertexRange checked_vertices(std::size_t cluster) const;
  void mark_vertices();

  const Mesh* mesh_ = nullptr;
  std::span<const MeshCluster> all_;
  std::size_t next_ = 0;  // of all_
  std::vector<std::size_t> clusters_;
  VertexRange range_{};
  std::vector<std::uint8_t> granules_;  // nonzero: the vertices of this granule of range_ are marked
};

}  // namespace edgewise

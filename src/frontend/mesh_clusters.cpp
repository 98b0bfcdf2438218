#include "frontend/mesh_clusters.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "core/finite.h"

namespace edgewise {

namespace {

// Requires that all vertices exist.
MeshCluster make_cluster(const Mesh& mesh, ClusterTriangles triangles) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  MeshCluster c{glm::vec3(kInfinity), glm::vec3(-kInfinity), ~0u, 0};
  bool all_finite = true;
  for (std::size_t i = 0; i < triangles.count; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t index = mesh.triangles[triangles.first + i][k];
      const glm::vec3 v = mesh.positions[index];
      c.first_vertex = std::min(c.first_vertex, index);
      c.end_vertex = std::max(c.end_vertex, index + 1);
      c.low = glm::min(c.low, v), c.high = glm::max(c.high, v);
      all_finite = all_finite && is_finite(v);
    }
  if (!all_finite) c.low = glm::vec3(-kInfinity), c.high = glm::vec3(kInfinity);
  return c;
}

}  // namespace

std::vector<MeshCluster> make_clusters(const Mesh& mesh) {
  std::vector<MeshCluster> clusters(cluster_count(mesh));
  for (std::size_t i = 0; i < clusters.size(); ++i) clusters[i] = make_cluster(mesh, triangles_of(mesh, i));
  return clusters;
}

void make_clusters(Drawable& drawable) {
  if (auto* scene = std::get_if<Scene>(&drawable))
    for (Mesh& mesh : scene->meshes) mesh.clusters = make_clusters(mesh);
}

std::vector<MeshCluster> clusters_of(const Mesh& mesh) {
  constexpr std::size_t kLeastTriangles = 1 << 16;
  const std::size_t vertices = mesh.positions.size();
  const auto exists = [&](glm::uvec3 t) { return std::max({t.x, t.y, t.z}) < vertices; };
  if (mesh.triangles.size() < kLeastTriangles && vertices <= ClusterPart::kMaxVertices) return {};
  if (!std::all_of(mesh.triangles.begin(), mesh.triangles.end(), exists)) return {};
  std::vector<MeshCluster> clusters = make_clusters(mesh);
  // If triangles name vertices in random order, most vertices belong to several parts, and each part
  // transforms them. Clusters still gain at two transforms per vertex: a second one costs less than fetching
  // a vertex from memory.
  ClusterPart part;
  part.start(mesh, clusters);
  std::size_t transformed = 0;
  while (part.take([](std::size_t) { return false; })) {
    part.for_each_vertex_range([&](std::size_t, std::size_t count) { transformed += count; });
    if (transformed > 2 * vertices) return {};
  }
  return clusters;
}

ViewSides::ViewSides(const ScreenTransform& to_screen, const ViewVolume& view) : origin_(to_screen.origin) {
  const glm::mat4x3& m = to_screen.rounded;
  const auto row = [&](int r) { return glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
  const glm::dvec4 w = row(2);
  // transform.cpp rounds each term at most five times, and the product with the width or height once more: at
  // most 6 · 2^-24 of the sum of the terms' absolute values. This is over twice that.
  constexpr double kRelativeError = 0x1p-20;
  const auto side = [](const glm::dvec4& start, const glm::dvec4& end) {
    return Side{end - start, kRelativeError * (glm::abs(end) + glm::abs(start))};
  };
  const glm::dvec4 nothing(0.0);
  sides_[0] = side(nothing, row(0)), sides_[1] = side(row(0), view.width_px * w);
  sides_[2] = side(nothing, row(1)), sides_[3] = side(row(1), view.height_px * w);
  sides_[4] = side({0, 0, 0, view.near_z}, w), sides_[5] = side(w, {0, 0, 0, view.far_z});
}

bool ViewSides::exclude(const MeshCluster& box) const {
  const glm::dvec3 low = glm::dvec3(box.low) - origin_, high = glm::dvec3(box.high) - origin_;
  const glm::dvec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
  for (const Side& side : sides_) {
    // The largest value of plane · v in the box.
    const double largest = glm::dot(glm::dvec3(side.plane), centre) + side.plane.w +
                           glm::dot(glm::abs(glm::dvec3(side.plane)), half);
    const double error = glm::dot(glm::dvec3(side.error), farthest) + side.error.w;
    // Values near the ends of float's range may overflow, or lose bits.
    if (largest + error < 0 && error > 0x1p-100 && error < 0x1p100) return true;
  }
  return false;
}

VertexRange ClusterPart::checked_vertices(std::size_t cluster) const {
  const VertexRange range = vertices_of(all_[cluster]);
  if (range.first < range.end && range.end <= mesh_->positions.size()) return range;
  throw std::invalid_argument("cluster " + std::to_string(cluster) + " of a mesh names vertices from " +
                              std::to_string(range.first) + " to before " + std::to_string(range.end) +
                              " of " + std::to_string(mesh_->positions.size()));
}

void ClusterPart::mark_vertices() {
  granules_.assign((range_.size() + kGranule - 1) / kGranule, 0);
  const auto granule_of = [&](std::size_t vertex) { return (vertex - range_.first) / kGranule; };
  for (const std::size_t cluster : clusters_) {
    const VertexRange range = vertices_of(all_[cluster]);
    if (range.size() <= kMaxVertices) {
      std::fill(granules_.begin() + static_cast<std::ptrdiff_t>(granule_of(range.first)),
                granules_.begin() + static_cast<std::ptrdiff_t>(granule_of(range.end - 1)) + 1,
                std::uint8_t{1});
      continue;
    }
    // The cluster spans two distant ranges of vertices, or it names vertices in random order.
    const ClusterTriangles triangles = triangles_of(*mesh_, cluster);
    for (std::size_t i = 0; i < triangles.count; ++i)
      for (int k = 0; k < 3; ++k) {
        const std::size_t vertex = mesh_->triangles[triangles.first + i][k];
        if (range.contains({vertex, vertex + 1})) granules_[granule_of(vertex)] = 1;  // else assemble() fails
      }
  }
}

}  // namespace edgewise

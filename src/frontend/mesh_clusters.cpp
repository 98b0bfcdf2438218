#include "frontend/mesh_clusters.h"

#include <algorithm>
#include <limits>

#include "core/finite.h"
#include "core/float_state.h"

namespace edgewise {

namespace {

// Requires that all vertices exist.
MeshCluster make_cluster(const Mesh& mesh, std::size_t cluster) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  MeshCluster c{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  bool all_finite = true;
  const std::size_t first = cluster * kClusterTriangles;
  for (std::size_t i = first; i < std::min(first + kClusterTriangles, mesh.triangles.size()); ++i)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 v = mesh.positions[mesh.triangles[i][k]];
      c.low = glm::min(c.low, v), c.high = glm::max(c.high, v);
      all_finite = all_finite && is_finite(v);
    }
  if (!all_finite) c.low = glm::vec3(-kInfinity), c.high = glm::vec3(kInfinity);
  return c;
}

}  // namespace

std::vector<MeshCluster> make_clusters(const Mesh& mesh) {
  std::vector<MeshCluster> clusters(cluster_count(mesh));
  for (std::size_t i = 0; i < clusters.size(); ++i) clusters[i] = make_cluster(mesh, i);
  return clusters;
}

void renew_clusters(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.clusters.size(); ++i) mesh.clusters[i] = make_cluster(mesh, i);
}

void make_clusters(Drawable& drawable) {
  if (auto* scene = std::get_if<Scene>(&drawable))
    for (Mesh& mesh : scene->meshes) mesh.clusters = make_clusters(mesh);
}

std::vector<MeshCluster> clusters_of(const Mesh& mesh) {
  const DefaultFloatState state;
  constexpr std::size_t kLeastTriangles = 1 << 16;
  const auto exists = [&](glm::uvec3 t) { return std::max({t.x, t.y, t.z}) < mesh.positions.size(); };
  const auto& triangles = mesh.triangles;
  if (triangles.size() < kLeastTriangles || !std::all_of(triangles.begin(), triangles.end(), exists))
    return {};
  return make_clusters(mesh);
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
  const glm::dvec4 z = to_screen.has_z ? to_screen.z : w;
  sides_[4] = side({0, 0, 0, view.near_z}, z);
  sides_[5] = side(z, glm::dvec4(0, 0, 0, view.far_z) + view.far_w * w);
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

}  // namespace edgewise

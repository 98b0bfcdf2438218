// Large meshes are cut into clusters, with the same output.
#include "frontend/mesh_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/random.h"
#include "edgewise/frontend.h"

namespace edgewise {
namespace {

constexpr unsigned kSide = 300;  // vertices: more than one cluster's

// A level grid around the camera, row by row.
Scene grid() {
  Scene scene;
  scene.instances.resize(1);
  Mesh& mesh = scene.meshes.emplace_back();
  for (unsigned y = 0; y < kSide; ++y)
    for (unsigned x = 0; x < kSide; ++x)
      mesh.positions.emplace_back(0.3f * (static_cast<float>(x) - 150.0f), -1.0f,
                                  0.3f * (static_cast<float>(y) - 150.0f));
  for (unsigned y = 0; y + 1 < kSide; ++y)
    for (unsigned x = 0; x + 1 < kSide; ++x) {
      const unsigned v = y * kSide + x;
      mesh.triangles.emplace_back(v, v + kSide, v + 1);
      mesh.triangles.emplace_back(v + 1, v + kSide, v + kSide + 1);
    }
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.colours.push_back(i);
  // Two faces of two halves each: at the first triangles, and where clusters meet.
  mesh.flags.assign(mesh.triangles.size(), 0);
  MeshClusters clusters;
  const std::size_t meet = clusters.cut(mesh, 1, SimdTarget::scalar)[0].end_triangle;
  mesh.flags[1] = mesh.flags[meet] = kSecondHalf;
  scene.camera.near_z = 0.5f;
  return scene;
}

void shuffle(std::vector<glm::uvec3>& triangles) {
  Random random(1);
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
}

std::span<const MeshCluster> clusters_of(MeshClusters& clusters, const Mesh& mesh, int threads = 2) {
  return clusters.cut(mesh, threads, resolve(SimdTarget::best));
}

TEST(MeshClusters, HoldEveryTriangleAndItsVertices) {
  const Mesh mesh = grid().meshes[0];
  ASSERT_GT(mesh.positions.size(), MeshClusters::kMaxVertices);
  MeshClusters clusters;
  std::size_t next = 0;
  for (const MeshCluster& cluster : clusters_of(clusters, mesh)) {
    EXPECT_EQ(cluster.first_triangle, next);
    EXPECT_LE(cluster.vertices(), MeshClusters::kMaxVertices);
    for (; next < cluster.end_triangle; ++next)
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(mesh.triangles[next][k], cluster.first_vertex);
        ASSERT_LT(mesh.triangles[next][k], cluster.end_vertex);
      }
  }
  EXPECT_EQ(next, mesh.triangles.size());
}

TEST(MeshClusters, AreOneForMeshesThatGainNothing) {
  Mesh mesh = grid().meshes[0];
  MeshClusters clusters;
  EXPECT_EQ(clusters_of(clusters, mesh).size(), 2u);
  mesh.triangles[7].y = kSide * kSide;
  EXPECT_EQ(clusters_of(clusters, mesh).size(), 1u) << "a vertex is missing";
  mesh = grid().meshes[0];
  shuffle(mesh.triangles);
  EXPECT_EQ(clusters_of(clusters, mesh).size(), 1u) << "in random order";
  Mesh soup;
  for (unsigned i = 0; i < 30'000; ++i) soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  soup.positions.resize(3 * soup.triangles.size());
  EXPECT_EQ(clusters_of(clusters, soup).size(), 2u);
  shuffle(soup.triangles);
  EXPECT_EQ(clusters_of(clusters, soup).size(), 1u) << "no shared vertices, in random order";
  mesh.triangles.clear();
  EXPECT_EQ(clusters_of(clusters, mesh).size(), 1u);
}

// Two meshes in one, whose triangles are no multiple of a chunk: the clusters meet within a chunk.
TEST(MeshClusters, MeetWithinAChunk) {
  Mesh mesh;
  mesh.positions.resize(80'000);
  Random random(3);
  for (unsigned part : {0u, 40'000u})
    for (int i = 0; i < 3001; ++i) {
      glm::uvec3 t;
      for (int k = 0; k < 3; ++k) t[k] = part + static_cast<unsigned>(random.below(40'000));
      mesh.triangles.push_back(t);
    }
  MeshClusters clusters;
  const auto cut = clusters_of(clusters, mesh);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_GE(cut[1].first_triangle, 3001u);
  EXPECT_LT(cut[1].first_triangle, 3010u);
}

std::vector<ScreenTriangle> output(const Scene& scene, Payload payload, int threads) {
  Frontend frontend;
  const auto triangles = frontend.run(scene, {.width = 320,
                                              .height = 200,
                                              .cull = Cull::none,
                                              .shade = false,
                                              .payload = payload,
                                              .threads = threads});
  return {triangles.begin(), triangles.end()};
}

TEST(MeshClusters, GiveTheTrianglesOfTheWholeMesh) {
  const Scene in_clusters = grid();
  Scene whole = in_clusters;  // many triangles without area, in random order, keep it whole
  Mesh& mesh = whole.meshes[0];
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto v = static_cast<unsigned>(random.below(mesh.positions.size()));
    mesh.triangles.emplace_back(v, v, static_cast<unsigned>(random.below(mesh.positions.size())));
  }
  mesh.colours.resize(mesh.triangles.size());
  mesh.flags.resize(mesh.triangles.size());
  MeshClusters clusters;
  ASSERT_GT(clusters_of(clusters, in_clusters.meshes[0]).size(), 1u);
  ASSERT_EQ(clusters_of(clusters, mesh).size(), 1u);
  for (const Payload payload : {Payload::colour, Payload::id}) {
    const auto expected = output(whole, payload, 1);
    ASSERT_GT(expected.size(), 1000u);
    for (const int threads : {1, 2, 5, 16}) {
      const auto given = output(in_clusters, payload, threads);
      ASSERT_EQ(given.size(), expected.size());
      EXPECT_EQ(std::memcmp(given.data(), expected.data(), expected.size() * sizeof expected[0]), 0);
    }
  }
}

TEST(MeshClusters, AreDroppedOneByOneOutsideTheView) {
  Scene scene = grid();
  scene.camera.position.z = -10.0f;  // behind it lies a whole cluster
  Frontend frontend;
  const FrontendOptions options{.width = 320, .height = 200, .cull = Cull::none, .keep_states = true};
  Scene small = scene;  // its states are in memory when the next frame begins
  small.camera.position.y = 1e6f;
  small.camera.far_z = 1e7f;
  small.camera.pitch = -1.5f;
  frontend.run(small, options);
  frontend.run(scene, options);
  FrontendStats stats = frontend.stats();
  EXPECT_EQ(stats.meshes_culled, 0u);
  EXPECT_GT(stats.whole_mesh, 0u);
  EXPECT_LT(stats.whole_mesh, stats.triangles);
  EXPECT_EQ(
      static_cast<std::uint64_t>(std::ranges::count(frontend.states(), TriangleState::outside_with_mesh)),
      stats.whole_mesh);
  scene.camera.position.z = -1000.0f;
  frontend.run(scene, options);
  stats = frontend.stats();
  EXPECT_EQ(stats.meshes_culled, 1u);
  EXPECT_EQ(stats.whole_mesh, stats.triangles);
}

}  // namespace
}  // namespace edgewise

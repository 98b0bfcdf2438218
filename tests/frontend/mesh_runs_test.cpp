// Large meshes are cut into runs of triangles, with the same output.
#include "frontend/mesh_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/random.h"
#include "edgewise/frontend.h"

namespace edgewise {
namespace {

constexpr unsigned kSide = 300;  // vertices: more than one run's

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
  mesh.colours.assign(mesh.triangles.size(), 0);
  scene.camera.near_z = 0.5f;
  return scene;
}

void shuffle(std::vector<glm::uvec3>& triangles) {
  Random random(1);
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
}

std::span<const MeshRun> runs_of(MeshRuns& runs, const Mesh& mesh, int threads = 2) {
  return runs.cut(mesh, threads, resolve(SimdTarget::best));
}

TEST(MeshRuns, HoldEveryTriangleAndItsVertices) {
  const Mesh mesh = grid().meshes[0];
  ASSERT_GT(mesh.positions.size(), MeshRuns::kMaxVertices);
  MeshRuns runs;
  std::size_t next = 0;
  for (const MeshRun& run : runs_of(runs, mesh)) {
    EXPECT_EQ(run.first_triangle, next);
    EXPECT_LE(run.vertices(), MeshRuns::kMaxVertices);
    for (; next < run.end_triangle; ++next)
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(mesh.triangles[next][k], run.first_vertex);
        ASSERT_LT(mesh.triangles[next][k], run.end_vertex);
      }
  }
  EXPECT_EQ(next, mesh.triangles.size());
}

TEST(MeshRuns, AreOneForMeshesThatGainNothing) {
  Mesh mesh = grid().meshes[0];
  MeshRuns runs;
  EXPECT_EQ(runs_of(runs, mesh).size(), 2u);
  mesh.triangles[7].y = kSide * kSide;
  EXPECT_EQ(runs_of(runs, mesh).size(), 1u) << "a vertex is missing";
  mesh = grid().meshes[0];
  shuffle(mesh.triangles);
  EXPECT_EQ(runs_of(runs, mesh).size(), 1u) << "in no order";
  mesh.triangles.clear();
  EXPECT_EQ(runs_of(runs, mesh).size(), 1u);
}

// Two meshes in one, whose triangles are no multiple of a chunk: the runs meet within a chunk.
TEST(MeshRuns, MeetWithinAChunk) {
  Mesh mesh;
  mesh.positions.resize(80'000);
  Random random(3);
  for (unsigned part : {0u, 40'000u})
    for (int i = 0; i < 3001; ++i) {
      glm::uvec3 t;
      for (int k = 0; k < 3; ++k) t[k] = part + static_cast<unsigned>(random.below(40'000));
      mesh.triangles.push_back(t);
    }
  MeshRuns runs;
  const auto cut = runs_of(runs, mesh);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_GE(cut[1].first_triangle, 3001u);
  EXPECT_LT(cut[1].first_triangle, 3010u);
}

std::vector<ScreenTriangle> sorted_output(const Scene& scene, int threads) {
  Frontend frontend;
  const auto triangles = frontend.run(
      scene, {.width = 320, .height = 200, .cull = Cull::none, .shade = false, .threads = threads});
  std::vector<ScreenTriangle> list(triangles.begin(), triangles.end());
  std::sort(list.begin(), list.end(), [](const ScreenTriangle& a, const ScreenTriangle& b) {
    return std::memcmp(&a, &b, sizeof a) < 0;
  });
  return list;
}

TEST(MeshRuns, GiveTheTrianglesOfTheWholeMesh) {
  const Scene in_runs = grid();
  Scene whole = in_runs;
  shuffle(whole.meshes[0].triangles);
  const auto expected = sorted_output(whole, 1);
  ASSERT_GT(expected.size(), 1000u);
  for (const int threads : {1, 2, 5}) {
    const auto given = sorted_output(in_runs, threads);
    ASSERT_EQ(given.size(), expected.size());
    EXPECT_EQ(std::memcmp(given.data(), expected.data(), expected.size() * sizeof expected[0]), 0);
  }
}

TEST(MeshRuns, AreDroppedOneByOneOutsideTheView) {
  Scene scene = grid();
  scene.camera.position.z = -10.0f;  // behind it lie whole runs
  Frontend frontend;
  const FrontendOptions options{.width = 320, .height = 200, .cull = Cull::none, .keep_states = true};
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

// Clusters let the front end skip parts of a mesh, with the same output.
#include "frontend/mesh_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/random.h"
#include "edgewise/frontend.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

constexpr unsigned kSide = 300;  // vertices per side; kSide² are more than a VertexWindow holds
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A level grid around the camera, row by row, with clusters.
Scene grid() {
  Mesh mesh;
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
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.normals.emplace_back(0, 1, i % 997);
  // Two faces of two triangles each: at the first triangles, and where clusters meet.
  mesh.flags.assign(mesh.triangles.size(), 0);
  mesh.flags[1] = mesh.flags[kClusterTriangles * 5] = kSameFace;
  mesh.clusters = clusters_of(mesh);
  Scene scene = testing::scene_of(std::move(mesh));
  scene.camera.near_z = 0.5f;
  return scene;
}

// Two grids in one mesh, the second in reverse order. They meet within a cluster, whose vertices are those of
// the first grid's end and the second one's.
Scene two_grids() {
  Scene scene = grid();
  Mesh& mesh = scene.meshes[0];
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t triangles = mesh.triangles.size();
  EXPECT_NE(triangles % kClusterTriangles, 0u);
  for (std::size_t i = 0; i < vertices; ++i) mesh.positions.push_back(-mesh.positions[i]);
  for (std::size_t i = 0; i < triangles; ++i) {
    mesh.triangles.push_back(mesh.triangles[triangles - 1 - i] + vertices);
    mesh.colours.push_back(mesh.colours[i] + 1'000'000);
    mesh.normals.push_back(-mesh.normals[i]);
    mesh.flags.push_back(0);
  }
  mesh.clusters = clusters_of(mesh);
  return scene;
}

TEST(MeshClusters, HoldTheirTrianglesVertices) {
  Mesh mesh = grid().meshes[0];
  ASSERT_EQ(mesh.clusters.size(), (mesh.triangles.size() + kClusterTriangles - 1) / kClusterTriangles);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const MeshCluster& cluster = mesh.clusters[i / kClusterTriangles];
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 v = mesh.positions[mesh.triangles[i][k]];
      ASSERT_EQ(glm::clamp(v, cluster.low, cluster.high), v);
    }
  }
  EXPECT_LT(mesh.clusters[0].high.x - mesh.clusters[0].low.x, 0.3f * kSide / 2);

  mesh.positions[mesh.triangles[300].y].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(clusters_of(mesh)[1].low, glm::vec3(-kInfinity));
  EXPECT_EQ(clusters_of(mesh)[1].high, glm::vec3(kInfinity));
}

TEST(MeshClusters, AreNoneForMeshesThatGainNothing) {
  Mesh mesh = grid().meshes[0];
  mesh.triangles[7].y = kSide * kSide;
  EXPECT_TRUE(clusters_of(mesh).empty()) << "a vertex is missing";
  mesh = grid().meshes[0];
  mesh.triangles.resize(65'536);
  EXPECT_FALSE(clusters_of(mesh).empty());
  mesh.triangles.pop_back();
  EXPECT_TRUE(clusters_of(mesh).empty()) << "small";
}

// Without clusters, a scene has the same triangles; those of dropped clusters are outside.
void expect_same_without_clusters(const Scene& scene, const FrontendOptions& options,
                                  const Execution& execution) {
  Scene whole = scene;
  whole.meshes[0].clusters.clear();
  Frontend expected, given;
  testing::expect_same_triangles(expected.run(whole, options, execution),
                                 given.run(scene, options, execution), "");
  EXPECT_GT(given.stats().whole_mesh, 0u);
  EXPECT_EQ(given.stats().meshes_culled, 0u);
  EXPECT_EQ(given.stats().whole_mesh + given.stats().outside, expected.stats().outside);
  for (std::size_t i = 0; i < given.states().size(); ++i)
    ASSERT_TRUE(given.states()[i] == expected.states()[i] ||
                (given.states()[i] == TriangleState::outside_with_mesh &&
                 expected.states()[i] == TriangleState::outside));
}

// Among other instances, mirrored and not; with shading, culling, a vertex that is not finite, ids and
// states.
TEST(MeshClusters, GiveTheTrianglesOfTheWholeMesh) {
  Scene scene = two_grids();
  scene.meshes[0].positions[kSide * 100 + 140].y = kInfinity;
  scene.meshes[0].clusters = clusters_of(scene.meshes[0]);
  scene.meshes.push_back({{{-1, 0, -5}, {1, 0, -5}, {0, 1, -5}}, {{0, 1, 2}, {0, 2, 1}}, {1, 2}});
  scene.instances = {{.mesh = 1}, {}, {.mesh = 1}, {.scale = {-1, 2, 0.5f}, .angle = 1}, {.mesh = 1}};
  for (const Cull cull : cull_modes())
    for (const SimdTarget target : supported_targets())
      for (const bool keep : {false, true}) {
        FrontendOptions options{.width = 320, .height = 200, .cull = cull};
        options.payload = keep ? Payload::id : Payload::colour;
        options.keep_unsnapped = options.keep_states = keep;
        expect_same_without_clusters(scene, options, {.threads = keep ? 3 : 16, .target = target});
      }
}

TEST(MeshClusters, AreDroppedOutsideTheView) {
  Scene scene = grid();
  Frontend frontend;
  const FrontendOptions options{.width = 320, .height = 200, .cull = Cull::none, .keep_states = true};
  Scene above = scene;  // its states are in memory when the next frame begins
  above.camera.position.y = 1e6f;
  above.camera.far_z = 1e7f;
  above.camera.pitch = -1.5f;
  frontend.run(above, options);
  const FrontendStats& stats = frontend.stats();
  EXPECT_EQ(stats.whole_mesh, 0u);
  frontend.run(scene, options);
  EXPECT_EQ(stats.meshes_culled, 0u);
  EXPECT_GT(stats.whole_mesh, stats.triangles / 2);
  EXPECT_LT(stats.whole_mesh, stats.triangles);
  EXPECT_EQ(
      static_cast<std::uint64_t>(std::ranges::count(frontend.states(), TriangleState::outside_with_mesh)),
      stats.whole_mesh);
  scene.camera.position.z = -1000.0f;
  frontend.run(scene, options);
  EXPECT_EQ(stats.meshes_culled, 1u);
  EXPECT_EQ(stats.whole_mesh, stats.triangles);
}

// A box of one vertex is excluded only if transform.cpp finds the vertex beyond a side, although that rounds
// to floats. The vertices lie as close to a side as floats can.
TEST(MeshClusters, ExcludeNoVertexThatFloatsFindInView) {
  Random random(5);
  const auto real = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random.below(1 << 20)) * 0x1p-20f;
  };
  const FrontendOptions options;
  const Mesh mesh;
  const TransformKernel kernel = transform_kernel(resolve(SimdTarget::best));
  int sides = 0, excluded = 0, in_view = 0;
  for (int i = 0; i < 100'000; ++i) {
    Camera camera;
    const float away = i % 2 == 0 ? 0.0f : 1e6f;  // from the origin
    camera.position = {away + real(-3, 3), real(-3, 3), real(-3, 3)};
    camera.yaw = real(-3, 3), camera.pitch = real(-1, 1);
    CameraMatrices matrices = matrices_of(camera, 1.6);
    if (i % 3 == 1) matrices = {glm::dmat4(1.0), matrices.projection * matrices.view};
    if (i % 3 == 2) matrices.projection = orthographic_projection(-80, 80, -50, 50, -20, 100);
    const View seen = i % 3 == 0 ? View(camera, 320, 200) : View(matrices, 320, 200);
    const MeshTask task{options, mesh, seen.volume, {seen, glm::dmat4(1.0)}, seen.depth};
    const ViewSides view(task.to_screen, seen.volume);
    const auto outside = [&](glm::vec3 v) {
      Vertex vertex;
      kernel(task, &v, 1, &vertex);
      return vertex.outside & kInvisible;
    };
    const auto vertex = [&] { return glm::vec3{away + real(-200, 200), real(-200, 200), real(-200, 200)}; };
    const auto excludes = [&](glm::vec3 v) { return view.exclude({v, v}); };
    glm::vec3 in = vertex(), out = vertex();
    if (outside(in) != 0 || outside(out) == 0) continue;
    const glm::vec3 outwards = out - in;
    for (int step = 0; step < 40; ++step) {
      const glm::vec3 middle = 0.5f * (in + out);
      (outside(middle) == 0 ? in : out) = middle;
    }
    for (int step = 0; step < 100; ++step) {
      glm::vec3 v = in;
      for (int k = 0; k < 3; ++k) v[k] *= 1 + real(-1, 1) * 0x1p-22f;
      in_view += outside(v) == 0;
      EXPECT_FALSE(outside(v) == 0 && excludes(v));
    }
    ++sides;
    excluded += excludes(out + 0.01f * outwards);
  }
  EXPECT_GT(in_view, 10 * sides);
  EXPECT_GT(sides, 500);
  EXPECT_GT(excluded, sides * 9 / 10);
}

TEST(MeshClusters, ExcludeNoBoxThatOverflowsOrIsNotFinite) {
  const ScreenTransform to_screen({Camera{}, 320, 200}, glm::dmat4(1.0));  // looks along -z
  const auto excludes = [](const ScreenTransform& m, glm::vec3 low, glm::vec3 high) {
    return ViewSides(m, view_volume({}, 320, 200)).exclude({low, high});
  };
  EXPECT_TRUE(excludes(to_screen, {-1, -1, 5}, {1, 1, 9}));
  EXPECT_FALSE(excludes(to_screen, {-1, -1, -5}, {1, 1, 9})) << "reaches into the view";
  EXPECT_FALSE(excludes(to_screen, {-90, -90, -1}, {-0.2f, -0.2f, -1})) << "a corner is in view";
  EXPECT_FALSE(excludes(to_screen, glm::vec3(-kInfinity), glm::vec3(kInfinity)));
  EXPECT_FALSE(excludes(to_screen, glm::vec3(std::numeric_limits<float>::quiet_NaN()), {1, 1, 9}));
  const ScreenTransform huge({Camera{}, 320, 200}, model_matrix({}, {.scale = glm::dvec3(1e37)}));
  EXPECT_FALSE(excludes(huge, {-1, -1, 5}, {1, 1, 9}));
}

TEST(MeshClusters, OfOtherTrianglesAreRefused) {
  Scene scene = grid();
  scene.meshes[0].triangles[51'300].y = kSide * kSide;
  EXPECT_NE(message_of([&] { Frontend().run(scene, {}); }).find("names vertex"), std::string::npos);
}

}  // namespace
}  // namespace edgewise

// The front end's kernels: every SIMD target and thread count makes what one triangle at a time does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "frontend/frontend.h"
#include "frontend/jobs.h"
#include "frontend/transform.h"
#include "raster/contract.h"
#include "scene/builtin.h"
#include "scene/random.h"

namespace edgewise {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

glm::vec3 spoiled(Random& random, glm::vec3 v) {
  const auto dice = random.below(100);
  if (dice < 2) v[static_cast<int>(random.below(3))] = dice == 0 ? kNan : kInf;
  if (dice == 2) v *= 1e35f;
  return v;
}

// Every size and distance, so that all planes cut something; `spoil` adds NaN, infinities and the edge of
// float. Not a whole number of vectors, and enough of them to be worth threads.
Scene wild_scene(bool spoil) {
  Random random(1);
  Mesh mesh;
  for (int i = 0; i < 9001; ++i) {
    const float reach = std::pow(10.0f, random.uniform(-3.0f, 6.0f));
    const glm::vec3 position(random.uniform(-reach, reach), random.uniform(-reach, reach),
                             random.uniform(-reach, reach));
    mesh.positions.push_back(spoil ? spoiled(random, position) : position);
  }
  for (int i = 0; i < 20011; ++i) {
    const auto vertex = [&] { return static_cast<unsigned>(random.below(mesh.positions.size())); };
    const unsigned a = vertex(), b = vertex();
    mesh.triangles.emplace_back(a, b, i % 16 == 0 ? a : vertex());
    mesh.colours.push_back(static_cast<std::uint32_t>(random.below(1ull << 32)));
  }
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({});
  scene.instances.push_back({.scale = {-1e-3f, 2e-3f, 1e-3f}, .angle = 1.1f, .translation = {1, 2, -30}});
  scene.camera.near_z = 1e-2f;
  scene.camera.far_z = 1e5f;
  return scene;
}

TriangleStream wild_stream() {
  Random random(2);
  TriangleStream stream{640, 480, {}};
  for (int i = 0; i < 20011; ++i) {
    StreamTriangle t{};
    const glm::vec2 centre(random.uniform(-100.0f, 740.0f), random.uniform(-100.0f, 580.0f));
    // Every tenth may cross the guard band or the planes of depth.
    const bool may_be_cut = i % 10 == 0;
    const float size = std::pow(10.0f, random.uniform(-2.0f, may_be_cut ? 6.0f : 2.5f));
    for (auto& v : t.vertex) {
      v = {centre.x + random.uniform(-size, size), centre.y + random.uniform(-size, size),
           may_be_cut ? random.uniform(-0.5f, 1.5f) : random.uniform(0.0f, 1.0f)};
      if (may_be_cut) v = spoiled(random, v);
    }
    if (i % 16 == 1) t.vertex[2] = t.vertex[0];
    t.colour = static_cast<std::uint32_t>(random.below(1ull << 32));
    stream.triangles.push_back(t);
  }
  return stream;
}

struct Result {
  std::vector<ScreenTriangle> triangles;
  FrontendStats stats;
};
Result run(const Drawable& drawable, const FrontendOptions& options) {
  Frontend frontend;
  const auto span = frontend.run(drawable, options);
  return {{span.begin(), span.end()}, frontend.stats()};
}

void expect_same_triangles(const std::vector<ScreenTriangle>& a, const std::vector<ScreenTriangle>& b,
                           const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << what << ", triangle " << i;
}

// With keep_unsnapped each triangle goes alone, and those without area stay.
std::vector<ScreenTriangle> one_by_one(const Drawable& drawable, FrontendOptions options) {
  options.keep_unsnapped = true;
  auto triangles = run(drawable, options).triangles;
  std::erase_if(triangles, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
  return triangles;
}

void expect_all_alike(const Drawable& drawable, FrontendOptions options) {
  const auto expected = one_by_one(drawable, options);
  options.threads = 1;
  options.target = SimdTarget::scalar;
  const FrontendStats stats = run(drawable, options).stats;
  EXPECT_GT(stats.emitted, 0u);
  for (const SimdTarget target : supported_targets())
    for (const int threads : {1, 2, 5}) {
      options.threads = threads;
      options.target = target;
      const auto found = run(drawable, options);
      const std::string what = std::string(name_of(target)) + ", " + std::to_string(threads) + " threads";
      expect_same_triangles(expected, found.triangles, what);
      EXPECT_EQ(std::memcmp(&stats, &found.stats, sizeof stats), 0) << what;
    }
}

TEST(FrontendKernels, MeshesAreAlikeOnEveryTargetAndThreadCount) {
  for (const bool spoil : {false, true})
    for (const Cull cull : {Cull::none, Cull::back, Cull::front})
      for (const Payload payload : {Payload::colour, Payload::id})
        expect_all_alike(wild_scene(spoil), {.width = 300, .height = 200, .cull = cull, .payload = payload});
  expect_all_alike(wild_scene(true), {.width = 300, .height = 200, .shade = false});
}

TEST(FrontendKernels, StreamsAreAlikeOnEveryTargetAndThreadCount) {
  for (const Cull cull : {Cull::none, Cull::back, Cull::front})
    for (const Payload payload : {Payload::colour, Payload::id})
      expect_all_alike(wild_stream(), {.width = 640, .height = 480, .cull = cull, .payload = payload});
}

TEST(FrontendKernels, BuiltInScenesAreAlikeOnEveryTarget) {
  for (const SceneInfo& info : builtin_scenes()) {
    SCOPED_TRACE(info.name);
    expect_all_alike(info.make({.width = 640, .height = 480, .scale = 0.01}), {.width = 640, .height = 480});
  }
}

TEST(FrontendKernels, TheWildOnesMeetEveryFate) {
  const auto mesh = run(wild_scene(true), {.width = 300, .height = 200}).stats;
  const auto stream = run(wild_stream(), {.width = 640, .height = 480}).stats;
  for (const auto& s : {mesh, stream})
    for (const auto count :
         {s.not_finite, s.outside, s.clipped_near, s.clipped_far, s.clipped_guard, s.culled, s.zero_area})
      EXPECT_GT(count, 0u);
}

// Coordinates on every border of the view volume when w is the given one, and next to it.
std::vector<float> borders(float w, float side_px) {
  std::vector<float> values{0.0f, -0.0f, 1e-45f, 3e38f, -3e38f, kNan, kInf, -kInf};
  for (const float border : {w, side_px * w, 16384.0f * w, -16384.0f * w, 0.5f * side_px * w})
    for (const float value : {border, std::nextafter(border, kInf), std::nextafter(border, -kInf)})
      values.push_back(value);
  return values;
}

TEST(FrontendKernels, VerticesOnEveryBorderAreJudgedAsOneByOne) {
  constexpr int kWidth = 640, kHeight = 480;
  const FrontendOptions options{.width = kWidth, .height = kHeight};
  for (const float w : {1.0f, 0.7f, 0.0f, -0.0f, -1.0f, 1e-45f, 1e-38f, 3e38f, kNan, kInf}) {
    Mesh mesh;
    for (const float x : borders(w, kWidth))
      for (const float y : borders(w, kHeight))
        for (const float z : borders(w, 2.0f)) mesh.positions.emplace_back(x, y, z);
    std::vector<Vertex> vertices(mesh.positions.size());
    MeshJob job{options, mesh, glm::mat4(1.0f), vertices.data()};
    job.to_screen[3][3] = w;
    for (const SimdTarget target : supported_targets()) {
      transform_kernel(target)(job, 0, vertices.size());
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex expected = make_vertex(transform(job.to_screen, mesh.positions[i]), kWidth, kHeight);
        ASSERT_EQ(vertices[i].outside, expected.outside) << name_of(target) << ", w = " << w << ", " << i;
        if ((expected.outside & (kMustClip | kNotFinite)) != 0) continue;
        ASSERT_EQ(std::memcmp(&vertices[i], &expected, sizeof expected), 0) << name_of(target) << ", " << i;
      }
    }
  }
}

TEST(FrontendKernels, StreamsOnEveryBorderAreAlike) {
  constexpr int kWidth = 640, kHeight = 480;
  Random random(3);
  const auto one_of = [&](float side_px) {
    const auto values = borders(1.0f, side_px);
    return values[random.below(values.size())];
  };
  TriangleStream stream{kWidth, kHeight, {}};
  for (int i = 0; i < 40'000; ++i) {
    StreamTriangle t{};
    // Half of them have all vertices on one vertical or horizontal line.
    const glm::vec2 line(one_of(kWidth), one_of(kHeight));
    for (auto& v : t.vertex)
      v = {i % 4 == 0 ? line.x : one_of(kWidth), i % 4 == 1 ? line.y : one_of(kHeight), random.below(2)};
    stream.triangles.push_back(t);
  }
  expect_all_alike(stream, {.width = kWidth, .height = kHeight, .cull = Cull::none});
}

// Runs of every length around a vector and a run: nothing is lost, doubled or moved at the seams.
TEST(FrontendKernels, RunsOfAnyLengthKeepTheOrder) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{15}, std::size_t{16}, std::size_t{17}, kRun - 1, kRun,
        kRun + 1, kWorthThreads - 1, kWorthThreads, 3 * kWorthThreads + 5}) {
    TriangleStream stream{100, 100, {}};
    for (std::size_t i = 0; i < count; ++i)
      stream.triangles.push_back({{{1, 1, 0.5f}, {50, 1, 0.5f}, {1, 50, 0.5f}}, 0});
    const auto found =
        run(stream, {.width = 100, .height = 100, .cull = Cull::none, .payload = Payload::id, .threads = 3});
    ASSERT_EQ(found.triangles.size(), count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(found.triangles[i].payload, i);
  }
}

// Each is cut into two, so there are more pieces than the first attempt has room for.
TEST(FrontendKernels, MakesRoomForThePiecesOfCutTriangles) {
  constexpr std::size_t kCount = 3 * kRun;
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = {{-1, -1, -5}, {1, -1, -5}, {0, -1, 5}};
  mesh.triangles.assign(kCount, {0, 1, 2});
  mesh.colours.assign(kCount, 7);
  scene.instances.push_back({});
  Frontend frontend;
  const FrontendOptions options{
      .width = 100, .height = 100, .cull = Cull::none, .payload = Payload::id, .threads = 2};
  for (int frame = 0; frame < 2; ++frame) {
    const auto found = frontend.run(scene, options);
    ASSERT_EQ(found.size(), 2 * kCount);
    EXPECT_EQ(frontend.stats().clipped_near, kCount);
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i].payload, i / 2);
  }
}

TEST(FrontendKernels, LaterFramesStayWhereTheFirstOneWas) {
  Frontend frontend;
  FrontendOptions options{.width = 300, .height = 200, .threads = 2};
  const Scene scene = wild_scene(false);
  const auto* first = frontend.run(scene, options).data();
  options.cull = Cull::none;
  EXPECT_EQ(frontend.run(scene, options).data(), first);
  EXPECT_EQ(frontend.run(wild_stream(), options).data(), first);
}

TEST(FrontendKernels, NamesTheTriangleWhoseVertexIsMissing) {
  Scene scene = wild_scene(false);
  scene.meshes[0].triangles[12345].y = 9001;
  for (const SimdTarget target : supported_targets())
    for (const int threads : {1, 2}) {
      Frontend frontend;
      try {
        frontend.run(scene, {.threads = threads, .target = target});
        ADD_FAILURE() << "no complaint";
      } catch (const std::invalid_argument& e) {
        EXPECT_STREQ(e.what(), "triangle 12345 names vertex 9001 of 9001");
      }
    }
  scene.meshes[0].positions.clear();
  EXPECT_THROW(run(scene, {}), std::invalid_argument);
}

TEST(FrontendKernels, AMeshWithoutAFiniteVertexIsNotOutOfSight) {
  Scene scene = wild_scene(false);
  for (auto& p : scene.meshes[0].positions) p.x = kNan;
  const auto stats = run(scene, {}).stats;
  EXPECT_EQ(stats.meshes_culled, 0u);
  EXPECT_EQ(stats.not_finite, stats.triangles);
}

}  // namespace
}  // namespace edgewise

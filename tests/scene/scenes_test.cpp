// The built-in scenes have their documented properties.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>

#include "edgewise/builtin.h"
#include "edgewise/frontend.h"
#include "frontend/view.h"
#include "lab/cases/backend_comparison.h"
#include "support.h"

namespace edgewise {
namespace {

const TriangleStream& stream_of(const Drawable& drawable) {
  return std::get<TriangleStream>(drawable);
}

std::vector<std::string_view> scene_names(bool stream) {
  std::vector<std::string_view> names;
  for (const auto& s : builtin_scenes())
    if (s.stream == stream) names.push_back(s.name);
  return names;
}

double area_px(const StreamTriangle& t) {
  const glm::dvec3 a(t.vertex[0]), b(t.vertex[1]), c(t.vertex[2]);
  return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2.0;
}

TEST(Scenes, StreamsHaveTheirTriangleCountsAndAreas) {
  const struct {
    const char* name;
    std::size_t count;
    double area;
  } kExpected[] = {{"large", 1'000, 45'000},
                   {"medium", 50'000, 400},
                   {"small", 1'000'000, 10},
                   {"micro", 2'000'000, 1},
                   {"sliver", 100'000, 125}};
  for (const auto& e : kExpected) {
    const Drawable drawable = find_scene(e.name).make({});
    const auto& triangles = stream_of(drawable).triangles;
    EXPECT_EQ(triangles.size(), e.count) << e.name;
    for (std::size_t i = 0; i < triangles.size(); i += triangles.size() / 97)
      EXPECT_NEAR(area_px(triangles[i]), e.area, e.area * 0.05) << e.name;
  }
}

TEST(Scenes, SliversAreLongAndHalfAPixelWide) {
  const Drawable drawable = find_scene("sliver").make({.scale = 0.01});
  for (const auto& t : stream_of(drawable).triangles) {
    const auto longest = std::max({glm::distance(glm::vec2(t.vertex[0]), glm::vec2(t.vertex[1])),
                                   glm::distance(glm::vec2(t.vertex[1]), glm::vec2(t.vertex[2])),
                                   glm::distance(glm::vec2(t.vertex[2]), glm::vec2(t.vertex[0]))});
    EXPECT_GT(longest, 400.0f);
    EXPECT_LT(2.0 * area_px(t) / longest, 0.7);
  }
}

TEST(Scenes, ScaleChangesTheCountOfStreams) {
  for (const auto name : scene_names(true)) {
    const auto count = [&](double scale) {
      return static_cast<double>(stream_of(find_scene(name).make({.scale = scale})).triangles.size());
    };
    EXPECT_NEAR(count(0.25) / count(1.0), 0.25, 0.03) << name;
  }
}

TEST(Scenes, RefuseAbsurdScales) {
  for (const double scale : {0.0, -1.0, std::nan(""), 1e9})
    for (const auto name : {"micro", "grid4", "quads", "knots"})
      EXPECT_THROW(find_scene(name).make({.scale = scale}), std::invalid_argument);
}

TEST(Scenes, EveryNameMakesTheSameSceneTwice) {
  for (const auto& info : builtin_scenes()) {
    const SceneRequest request{.width = 200, .height = 150, .time = 0.5f, .scale = 0.01};
    FrontendOptions options{.width = 200, .height = 150, .cull = Cull::none};
    Frontend a, b;
    const auto first = a.run(info.make(request), options), second = b.run(info.make(request), options);
    ASSERT_GT(first.size(), 0u) << info.name;
    ASSERT_EQ(first.size(), second.size()) << info.name;
    EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size_bytes()), 0) << info.name;
  }
}

// The signed volume is positive if triangles are counter-clockwise from outside. Ours are clockwise.
TEST(Scenes, ClosedMeshesShowTheirFrontOutside) {
  for (const auto name : {"cube", "sphere", "torus-knot"}) {
    const auto scene = std::get<Scene>(find_scene(name).make({}));
    double volume = 0;
    for (const auto& mesh : scene.meshes)
      for (const auto& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
      }
    EXPECT_LT(volume, -1.0) << name;
  }
}

// Every edge is used once in each direction. Edges are compared by position, since seams repeat vertices.
TEST(Scenes, ClosedMeshesHaveNoSeam) {
  for (const auto name : {"cube", "sphere", "torus-knot"}) {
    const auto scene = std::get<Scene>(find_scene(name).make({}));
    std::map<std::array<float, 6>, int> edges;
    for (const auto& mesh : scene.meshes)
      for (const auto& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
          const glm::vec3 p = mesh.positions[t[i]], q = mesh.positions[t[(i + 1) % 3]];
          ++edges[{p.x, p.y, p.z, q.x, q.y, q.z}];
          --edges[{q.x, q.y, q.z, p.x, p.y, p.z}];
        }
    EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }), 0)
        << name;
  }
}

TEST(Scenes, TerrainSurroundsTheCameraAndCrossesTheNearPlane) {
  Frontend frontend;
  frontend.run(find_scene("terrain").make({}), {});
  const FrontendStats& s = frontend.stats();
  EXPECT_EQ(s.triangles, 524'288u);
  EXPECT_GT(s.clipped_near, 0u);
  EXPECT_GT(s.outside + s.whole_mesh, s.triangles / 2);
  EXPECT_GT(s.emitted, 10'000u);
}

TEST(Scenes, QuadsCoverEachPixelThreeTimes) {
  constexpr int kWidth = 200, kHeight = 100;
  const SceneInfo& quads = find_scene("quads");
  Frontend frontend;
  const Drawable drawable = quads.make({.width = kWidth, .height = kHeight});
  const auto triangles =
      frontend.run(drawable, {.width = kWidth, .height = kHeight, .cull = Cull::none, .shade = false});
  EXPECT_EQ(lab::covered_pixels(triangles, kWidth, kHeight), 3u * kWidth * kHeight);
  ASSERT_EQ(triangles.size(), 2u * (13 * 7 + 7 * 4 + 4 * 2));
  for (const ScreenTriangle& t : triangles)
    for (int i = 0; i < 3; ++i) EXPECT_EQ((t.x_q15[i] | t.y_q15[i]) % (16 * contract::kPixel_q15), 0);
  const auto count = [&](double scale) {
    const Drawable scaled = quads.make({.width = kWidth, .height = kHeight, .scale = scale});
    return stream_of(scaled).triangles.size();
  };
  EXPECT_EQ(count(0.1), 26u);
  EXPECT_EQ(count(2.5), 635u);
}

TEST(Scenes, ScaleChangesTheNumberOfKnotInstances) {
  const auto instances = [](double scale) {
    const Scene scene = std::get<Scene>(find_scene("knots").make({.scale = scale}));
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 49'152u);
    return scene.instances.size();
  };
  EXPECT_EQ(instances(1.0), 36u);
  EXPECT_EQ(instances(0.1), 4u);
  EXPECT_EQ(instances(0.001), 1u);
  EXPECT_EQ(instances(4.0), 144u);
}

class Grids : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Grids, CoverEveryPixelExactlyOnceByEveryBackend) {
  for (const auto& [width, height] : {std::pair{331, 203}, {64, 64}, {5, 7}}) {
    const Drawable drawable = find_scene(GetParam()).make({.width = width, .height = height});
    Frontend frontend;
    const auto triangles = frontend.run(drawable, {.width = width, .height = height, .cull = Cull::none});
    for (const auto& info : backends()) {
      const auto hits = lab::count_hits(*info.make(), triangles, width, height, {.threads = 2});
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1u), width * height) << info.name;
    }
    EXPECT_EQ(lab::covered_pixels(triangles, width, height), static_cast<std::uint64_t>(width * height));
  }
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, Grids, ::testing::Values("grid4", "grid64"),
                         [](const auto& param) { return testing::test_name(param); });

TEST(Camera, LooksAtItsTarget) {
  for (const glm::vec3 target : {glm::vec3(1, 2, -8), {-4, 0, 3}, {0, 5, 0.01f}, {2, -7, 2}}) {
    Scene scene = std::get<Scene>(find_scene("cube").make({}));
    scene.camera.position = {0.5f, -0.25f, 1.0f};
    scene.camera.look_at(target);
    scene.instances[0] = {.scale = glm::vec3(1e-3f), .translation = target};
    Frontend frontend;
    const auto triangles = frontend.run(scene, {.width = 100, .height = 100, .cull = Cull::none});
    ASSERT_FALSE(triangles.empty());
    EXPECT_NEAR(triangles[0].x_q15[0], 50 * contract::kPixel_q15, 40 << Coarse::kSpareBits);
    EXPECT_NEAR(triangles[0].y_q15[0], 50 * contract::kPixel_q15, 40 << Coarse::kSpareBits);
  }
}

// Of all positions and targets that differ in the signs of their zeros only.
TEST(Camera, LooksTheSameWayWhateverTheSignsOfZeros) {
  for (const glm::vec3 direction :
       {glm::vec3(0, 6, 0), {0, -6, 0}, {0, 0, 6}, {0, 0, -6}, {6, 0, 0}, {-6, 0, 0}}) {
    Camera first;
    first.look_at(direction);
    for (unsigned signs = 0; signs < 64; ++signs) {
      const auto signed_zero = [&](int bit) { return (signs >> bit & 1) != 0 ? -0.0f : 0.0f; };
      Camera camera;
      glm::vec3 target = direction;
      for (int i = 0; i < 3; ++i) {
        camera.position[i] = signed_zero(i);
        if (target[i] == 0.0f) target[i] = signed_zero(3 + i);
      }
      camera.look_at(target);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(camera.yaw), std::bit_cast<std::uint32_t>(first.yaw)) << signs;
      EXPECT_EQ(std::bit_cast<std::uint32_t>(camera.pitch), std::bit_cast<std::uint32_t>(first.pitch))
          << signs;
    }
  }
}

TEST(Camera, LooksStraightUpAndDownWithYaw0) {
  for (const float sign : {-1.0f, 1.0f}) {
    Camera camera;
    camera.yaw = 2.0f;
    camera.position = {1, 2, 3};
    camera.look_at({1, 2 + 6 * sign, 3});
    EXPECT_EQ(camera.yaw, 0.0f);
    EXPECT_EQ(camera.pitch, sign * 1.57079633f);
    const glm::dvec3 seen = pixels_of(camera, 2, 2) * glm::dvec3(0, 0, sign);
    EXPECT_NEAR(seen.x, 0.0, 1e-6);
    EXPECT_LT(seen.y, -1.0) << "towards the image's top";
    EXPECT_NEAR(seen.z, 0.0, 1e-6);
  }
}

TEST(Fit, CentresAndScalesTheLongestSideToTwo) {
  Scene scene = std::get<Scene>(find_scene("torus-knot").make({}));
  scene.instances[0].scale = {3, 5, 0.5f};
  scene.instances[0].translation = {100, -20, 7};
  fit(scene);
  glm::vec3 low(1e9f), high(-1e9f);
  const glm::mat4 model = model_matrix({}, scene.instances[0]);
  for (const auto& p : scene.meshes[0].positions) {
    low = glm::min(low, glm::vec3(model * glm::vec4(p, 1)));
    high = glm::max(high, glm::vec3(model * glm::vec4(p, 1)));
  }
  EXPECT_NEAR(glm::length(low + high), 0.0f, 1e-4f);
  EXPECT_NEAR(std::max({high.x - low.x, high.y - low.y, high.z - low.z}), 2.0f, 1e-4f);
}

TEST(Fit, RefusesOverflowWithoutChangingTheScene) {
  const auto scene_of_size = [](float size) {
    Scene scene;
    scene.meshes.push_back({{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}, {0}});
    scene.instances.emplace_back();
    return scene;
  };
  Scene small = scene_of_size(1e-29f), too_small = scene_of_size(1e-38f);
  EXPECT_NO_THROW(fit(small));
  EXPECT_DOUBLE_EQ(small.instances[0].scale.x * 1e-29f, 2.0);
  EXPECT_THROW(fit(too_small), std::invalid_argument);
  EXPECT_EQ(too_small.instances[0].scale, glm::dvec3(1.0));
  Scene far = scene_of_size(1e-20f), too_large = scene_of_size(3e38f);
  for (glm::vec3& p : far.meshes[0].positions) p.z = 1e20f;
  too_large.meshes[0].positions[0].x = -3e38f;
  EXPECT_THROW(fit(far), std::invalid_argument);
  EXPECT_THROW(fit(too_large), std::invalid_argument);
}

TEST(Fit, RefusesAnInstanceOfAMissingMesh) {
  Scene scene;
  scene.instances.push_back({.mesh = 1});
  scene.meshes.resize(1);
  EXPECT_THROW(fit(scene), std::out_of_range);
  EXPECT_THROW(frame_camera(scene), std::out_of_range);
}

}  // namespace
}  // namespace edgewise

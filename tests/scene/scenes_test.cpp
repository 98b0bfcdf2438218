// The built-in scenes have their documented properties.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "edgewise/builtin.h"
#include "edgewise/frontend.h"
#include "frontend/view.h"
#include "lab/cases/backend_comparison.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(Scenes, RefuseAbsurdScales) {
  for (const double scale : {0.0, -1.0, std::nan(""), 1e9})
    for (const auto name : {"micro", "grid4", "quads", "knots"})
      EXPECT_THROW(find_scene(name).make({.scale = scale}), std::invalid_argument);
}

// The signed volume is negative if triangles are clockwise from outside. Every edge is used once in each
// direction; edges are compared by position, since seams repeat vertices.
TEST(Scenes, ClosedMeshesShowTheirFrontOutsideAndHaveNoSeam) {
  for (const auto name : {"cube", "sphere", "torus-knot"}) {
    const auto scene = std::get<Scene>(find_scene(name).make({}));
    double volume = 0;
    std::map<std::array<float, 6>, int> edges;
    for (const auto& mesh : scene.meshes)
      for (const auto& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        for (int i = 0; i < 3; ++i) {
          const glm::vec3 p = mesh.positions[t[i]], q = mesh.positions[t[(i + 1) % 3]];
          ++edges[{p.x, p.y, p.z, q.x, q.y, q.z}];
          --edges[{q.x, q.y, q.z, p.x, p.y, p.z}];
        }
      }
    EXPECT_LT(volume, -1.0) << name;
    EXPECT_TRUE(std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; })) << name;
  }
}

TEST(Scenes, GridsAndQuadsCoverEveryPixelEquallyOftenByEveryBackend) {
  for (const auto& [name, times] : {std::pair{"grid4", 1u}, {"grid64", 1u}, {"quads", 3u}})
    for (const auto& [width, height] : {std::pair{331, 203}, {64, 64}, {5, 7}}) {
      const Drawable drawable = find_scene(name).make({.width = width, .height = height});
      Frontend frontend;
      const auto triangles = frontend.run(drawable, {.width = width, .height = height, .cull = Cull::none});
      for (const auto& info : backends()) {
        const auto hits = lab::count_hits(*info.make(), triangles, width, height, {.threads = 2});
        EXPECT_EQ(std::count(hits.begin(), hits.end(), times), width * height) << name << info.name;
      }
    }
}

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

TEST(Fit, RefusesOverflowWithoutChangingTheSceneAndMissingMeshes) {
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
  far.instances.push_back({.mesh = 1});
  EXPECT_THROW(fit(far), std::out_of_range);
  EXPECT_THROW(frame_camera(far), std::out_of_range);
}

}  // namespace
}  // namespace edgewise

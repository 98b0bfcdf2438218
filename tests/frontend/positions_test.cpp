// Rule 10: positions far from the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "core/random.h"
#include "edgewise/backend.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "support.h"

namespace edgewise {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

using Exact = glm::tvec3<long double>;

// Where a vertex of an instance without scale or rotation is seen: x and y in pixels, and w.
Exact seen(const Camera& camera, const Instance& instance, glm::vec3 position) {
  const Exact v = Exact(position) + (Exact(instance.translation) - Exact(camera.position));
  const long double yaw = camera.yaw, pitch = camera.pitch;
  const long double x = std::cos(yaw) * v.x - std::sin(yaw) * v.z,
                    back = std::sin(yaw) * v.x + std::cos(yaw) * v.z;
  const long double y = std::cos(pitch) * v.y + std::sin(pitch) * back,
                    w = std::sin(pitch) * v.y - std::cos(pitch) * back;
  const long double focal = kHeight / 2.0L / std::tan(static_cast<long double>(camera.fov_y) / 2);
  return {kWidth / 2.0L + focal * x / w, kHeight / 2.0L - focal * y / w, w};
}

float spread(Random& random, float reach) {
  return random.uniform(-reach, reach);
}

// A triangle about `distance` before a camera that is `away` from the origin: in the mesh, or by the
// instance.
Scene triangle_far_away(Random& random, double away, double distance, bool in_mesh) {
  Scene scene;
  Camera& camera = scene.camera;
  camera.yaw = spread(random, 3.0f), camera.pitch = spread(random, 1.5f), camera.fov_y = 0.785398163f;
  camera.near_z = static_cast<float>(distance / 100), camera.far_z = static_cast<float>(distance * 100);
  camera.position = away * glm::dvec3(spread(random, 1), spread(random, 1), spread(random, 1));
  const glm::dvec3 forward(-std::sin(camera.yaw) * std::cos(camera.pitch), std::sin(camera.pitch),
                           -std::cos(camera.yaw) * std::cos(camera.pitch));
  const glm::dvec3 base = in_mesh ? glm::dvec3(0.0) : camera.position;
  Mesh& mesh = scene.meshes.emplace_back();
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 aside(spread(random, 0.3f), spread(random, 0.3f), spread(random, 0.3f));
    mesh.positions.emplace_back(camera.position - base + distance * (forward + aside));
  }
  mesh.triangles = {{0, 1, 2}};
  mesh.colours = {0};
  scene.instances.push_back({.translation = base});
  return scene;
}

TEST(Positions, AreWithinTheContractsBoundHoweverFarTheOriginIs) {
  Random random(61);
  Frontend frontend;
  int vertices = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const double distance = std::ldexp(1.0, static_cast<int>(random.below(20)) - 10);
    const double away = trial % 4 == 0 ? 0.0 : std::ldexp(distance, static_cast<int>(random.below(24)));
    const Scene scene = triangle_far_away(random, away, distance, trial % 2 == 0);
    const Mesh& mesh = scene.meshes[0];
    const auto triangles =
        frontend.run(scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .keep_unsnapped = true});
    if (frontend.stats().clipped != 0 || triangles.empty()) continue;
    const double focal = kHeight / 2.0 / std::tan(double{scene.camera.fov_y} / 2);
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 p = mesh.positions[static_cast<std::size_t>(k)];
      const Exact exact = seen(scene.camera, scene.instances[0], p);
      if (exact.x < 0 || exact.x > kWidth || exact.y < 0 || exact.y > kHeight) continue;
      const Exact v = Exact(p) + (Exact(scene.instances[0].translation) - Exact(scene.camera.position));
      const double bound =
          contract::kPositionError * (focal + 2 * kWidth) * static_cast<double>(glm::length(v) / exact.z);
      ASSERT_NEAR(frontend.unsnapped()[0].x_px[k], static_cast<double>(exact.x), bound) << trial;
      ASSERT_NEAR(frontend.unsnapped()[0].y_px[k], static_cast<double>(exact.y), bound) << trial;
      ++vertices;
    }
  }
  EXPECT_GT(vertices, 20'000);
}

// A floor below the camera whose corners are up to 2^30 times farther away than what is seen of it. Of a new
// vertex on the near plane, w is known.
TEST(Positions, OfNewVerticesHardlyDependOnTheCornersDistance) {
  Random random(62);
  Frontend frontend;
  int vertices = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const float reach = std::ldexp(1.0f, 4 + static_cast<int>(random.below(27)));
    Scene scene;
    Camera& camera = scene.camera;
    camera.position = {spread(random, 3), 1.0, spread(random, 3)};
    camera.yaw = spread(random, 3), camera.pitch = random.uniform(-0.6f, -0.2f);
    camera.near_z = 1.0f, camera.far_z = 1000.0f;
    scene.meshes.push_back({{{-reach, 0, -reach}, {reach, 0, -reach}, {0, 0, 2 * reach}}, {{0, 1, 2}}, {0}});
    scene.instances.emplace_back();
    frontend.run(scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .keep_unsnapped = true});
    ASSERT_FALSE(frontend.unsnapped().empty()) << reach;
    const double focal = kHeight / 2.0 / std::tan(double{camera.fov_y} / 2), pitch = camera.pitch;
    const double expected = kHeight / 2.0 + focal * (1.0 + std::sin(pitch)) / std::cos(pitch);
    const double bound = 0x1p-10 + 0x1p-50 * (focal + kWidth) * 3 * double{reach};
    for (const UnsnappedTriangle& t : frontend.unsnapped())
      for (int k = 0; k < 3; ++k) {
        if (t.z01[k] > 1e-12f) continue;
        ASSERT_NEAR(double{t.y_px[k]}, expected, bound) << "reach " << reach;
        ++vertices;
      }
  }
  EXPECT_GT(vertices, 2000);
}

// One of the shared corners is so close to the near plane that floats, which decide, may place it in view,
// and doubles just outside.
TEST(Positions, ClippedTrianglesKeepTheCornersTheyShare) {
  Random random(63);
  Frontend frontend;
  int pairs = 0, before_near = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    Scene scene;
    Camera& camera = scene.camera;
    camera.position = {spread(random, 3), spread(random, 3), spread(random, 3)};
    camera.yaw = spread(random, 3), camera.pitch = spread(random, 1.5f), camera.near_z = 0.5f;
    const glm::dvec3 right(std::cos(camera.yaw), 0, -std::sin(camera.yaw));
    const glm::dvec3 forward(-std::sin(camera.yaw) * std::cos(camera.pitch), std::sin(camera.pitch),
                             -std::cos(camera.yaw) * std::cos(camera.pitch));
    const auto point = [&](double w) {
      const double x{spread(random, 0.3f)}, y{spread(random, 0.3f)};
      return glm::vec3(camera.position + w * (forward + x * right + y * glm::cross(right, forward)));
    };
    const glm::vec3 a = point(0.5 + 0.5 * double{spread(random, 0x1p-21f)}),
                    b = point(double{random.uniform(1, 50)}), c = point(double{random.uniform(1, 50)}),
                    behind = point(-double{random.uniform(1, 50)});
    scene.meshes.push_back({{a, b, c, behind}, {{0, 1, 2}, {1, 0, 3}}, {0, 0}});
    scene.instances.emplace_back();
    const auto triangles = frontend.run(scene, {.width = kWidth,
                                                .height = kHeight,
                                                .cull = Cull::none,
                                                .payload = Payload::id,
                                                .keep_unsnapped = true});
    if (frontend.stats().clipped != 1) continue;
    ++pairs;
    before_near += seen(camera, scene.instances[0], a).z < camera.near_z;
    const ScreenTriangle& whole = triangles[0];
    for (int k = 0; k < 2; ++k)
      ASSERT_TRUE(std::any_of(triangles.begin() + 1, triangles.end(),
                              [&](const ScreenTriangle& t) {
                                const auto has = [&](int i) {
                                  return t.x_q15[i] == whole.x_q15[k] && t.y_q15[i] == whole.y_q15[k] &&
                                         t.z[i] == whole.z[k];
                                };
                                return has(0) || has(1) || has(2);
                              }))
          << trial << ", corner " << k;
  }
  EXPECT_GT(pairs, 5000);
  EXPECT_GT(before_near, 50);
}

// The longest side is a millionth of the distance from the origin, as in survey coordinates.
TEST(Positions, FitAndFrameCameraKeepWhatIsFarFromTheOrigin) {
  Scene near = std::get<Scene>(find_scene("torus-knot").make({}));
  for (glm::vec3& p : near.meshes[0].positions) p = glm::round(p * 8.0f);  // floats hold them when moved
  Scene far = near;
  for (glm::vec3& p : far.meshes[0].positions) p += glm::vec3(412'348, 0, -5'572'096);
  for (const bool fitted : {false, true}) {
    for (Scene* scene : {&near, &far}) {
      if (fitted) fit(*scene);
      frame_camera(*scene);
    }
    Frontend here, there;
    const FrontendOptions options{.width = 640, .height = 480, .cull = Cull::none};
    const auto a = here.run(near, options), b = there.run(far, options);
    EXPECT_EQ(there.stats().outside + there.stats().whole_mesh, 0u);
    ASSERT_EQ(a.size(), b.size()) << fitted;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int k = 0; k < 3; ++k)
        moved +=
            std::abs(a[i].x_q15[k] - b[i].x_q15[k]) > 128 || std::abs(a[i].y_q15[k] - b[i].y_q15[k]) > 128;
    EXPECT_EQ(moved, 0u) << fitted;
  }
}

TEST(Positions, ACameraAtAnyFiniteDistanceSeesNothingBeyondItsFarPlane) {
  for (const double away : {1e9, 1e39, 1e200, 1e308}) {
    Scene scene = std::get<Scene>(find_scene("cube").make({}));
    scene.camera.position.z += away;
    Frontend frontend;
    EXPECT_TRUE(frontend.run(scene, {}).empty()) << away;
    EXPECT_EQ(frontend.stats().meshes_culled, frontend.stats().meshes) << away;
  }
}

// A box three times as high as wide fits a portrait picture, whichever way it lies.
TEST(Positions, FrameCameraShowsAllOfAScene) {
  for (const double aspect : {0.25, 0.5, 1.0, 3.0})
    for (const glm::dvec3 scale : {glm::dvec3(1, 4, 1), glm::dvec3(4, 1, 1), glm::dvec3(1, 1, 4)}) {
      Scene scene = std::get<Scene>(find_scene("cube").make({}));
      scene.instances[0].scale = scale;
      scene.meshes[0].positions.emplace_back(1e6f);  // a stray vertex, which no triangle names
      frame_camera(scene, aspect);
      const int width = static_cast<int>(400 * aspect);
      Frontend frontend;
      for (const ScreenTriangle& t : frontend.run(scene, {.width = width, .height = 400, .cull = Cull::none}))
        for (int k = 0; k < 3; ++k) {
          EXPECT_TRUE(t.x_q15[k] >= 0 && t.x_q15[k] <= width * contract::kPixel_q15) << aspect;
          EXPECT_TRUE(t.y_q15[k] >= 0 && t.y_q15[k] <= 400 * contract::kPixel_q15) << aspect;
        }
      EXPECT_LT(bounds_of(scene).high.x, 10);
      EXPECT_EQ(frontend.stats().emitted, frontend.stats().triangles);
    }
}

}  // namespace
}  // namespace edgewise

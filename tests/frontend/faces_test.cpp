// Faces of more than three vertices, and two-sided faces, in the front end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/shade.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::expect_same_triangles;
using testing::run;

// Quads and triangles, some two-sided, all around the camera, so that many are clipped.
Scene scene_of_quads(bool two_sided) {
  Random random(5);
  Mesh mesh;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const float reach = i % 3 == 0 ? 5.0f : 0.3f;
    const glm::vec3 at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-9, 1));
    const auto edge = [&] {
      return glm::vec3(random.uniform(-reach, reach), random.uniform(-reach, reach),
                       random.uniform(-reach, reach));
    };
    const glm::vec3 u = edge(), v = edge();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {at, at + u, at + u + v, at + v});
    const bool both = two_sided && i % 4 == 0;
    mesh.add_quad({first, first + 1, first + 2, first + 3}, rgb(i % 256, 200, 90), both);
    if (i % 5 != 0) continue;
    mesh.triangles.emplace_back(first, first + 2, first + 1);
    mesh.colours.push_back(rgb(10, i % 256, 20));
    mesh.flags.push_back(both ? kTwoSided : 0);
  }
  Scene scene = testing::scene_of(std::move(mesh));
  scene.instances.push_back({.scale = {-1, 1, 1}, .angle = 1.0f, .translation = {0, 0, -6}});
  return scene;
}

FrontendOptions with(Cull cull, Payload payload = Payload::colour) {
  return {.width = 320, .height = 200, .cull = cull, .payload = payload};
}

TEST(Faces, AreTheSameOnEveryTargetAndThreadCount) {
  const Scene scene = scene_of_quads(true);
  for (const Cull cull : cull_modes())
    for (const Payload payload : {Payload::colour, Payload::id}) {
      FrontendOptions options = with(cull, payload);
      options.keep_unsnapped = true;
      auto expected = run(scene, options).triangles;
      std::erase_if(expected, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
      ASSERT_FALSE(expected.empty());
      options.keep_unsnapped = false;
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 3}) {
          const auto found = run(scene, options, {.threads = threads, .target = target}).triangles;
          expect_same_triangles(found, expected, std::string(name_of(target)));
        }
    }
}

TEST(Faces, WithFourVerticesHaveOneColourAndTwoIds) {
  const Scene scene = scene_of_quads(false);
  const Mesh& mesh = scene.meshes[0];
  const auto ids = run(scene, with(Cull::none, Payload::id)).triangles,
             colours = run(scene, with(Cull::none)).triangles;
  ASSERT_EQ(ids.size(), colours.size());
  const auto lit = lit_colours(scene);
  std::size_t second_halves = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t id = ids[i].payload;
    EXPECT_EQ(colours[i].payload, lit[id]);
    if (!mesh.has_flag(id % mesh.triangles.size(), kSameFace)) continue;
    EXPECT_EQ(lit[id], lit[id - 1]);
    ++second_halves;
  }
  EXPECT_GT(second_halves, 100u);
}

TEST(Faces, NormalIsThatOfTheWholePolygon) {
  const glm::vec3 a(0, 0, 0), b(0, 2, 0), c(2, 2, 0), d(2, 0, 0), front(0, 0, 1), none(0.0f);
  const auto normal = [](std::vector<glm::vec3> vertices) {
    const glm::vec3 first = face_normal(vertices);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      std::rotate(vertices.begin(), vertices.begin() + 1, vertices.end());
      EXPECT_EQ(face_normal(vertices), first) << i;
    }
    return first;
  };
  EXPECT_EQ(normal({a, b, c, d}), front);
  EXPECT_EQ(normal({d, c, b, a}), -front);
  EXPECT_EQ(normal({a, a, b, b, b, c, d}), front) << "doubled corners";
  EXPECT_EQ(normal({a, {0, 1, 0}, b, {1, 2, 0}, c, {2, 0.5f, 0}, d}), front) << "straight corners";
  EXPECT_EQ(normal({a, b, {0.25f, 0.25f, 0}, d}), front) << "a reflex corner";
  EXPECT_EQ(normal({a, b, d, c}), none) << "a bow tie";
  EXPECT_EQ(normal({a, b, {0, 1, 0}}), none) << "no area";
  EXPECT_EQ(normal({a * 1e30f, b * 1e30f, c * 1e30f}), front);
  EXPECT_EQ(normal({a * 1e-40f, b * 1e-40f, c * 1e-40f}), front);
  const glm::vec3 bent = face_normal(std::vector<glm::vec3>{a, b + front, c, d + front});
  EXPECT_EQ(bent, front) << "the mean of the halves";
}

TEST(Faces, WithoutANormalGetAmbientLight) {
  Mesh mesh;
  mesh.positions = {{-1, -1, -3}, {-1, 1, -3}, {1, -1, -3}, {1, 1, -3}};
  mesh.add_quad({0, 1, 2, 3}, rgb(200, 200, 200));
  Scene scene = testing::scene_of(std::move(mesh));
  scene.meshes.emplace_back(), scene.instances.push_back({.mesh = 1});  // without triangles
  scene.to_light = {0, 0, 1};
  EXPECT_EQ(lit_colours(scene), std::vector<std::uint32_t>(2, rgb(30, 30, 30)));
}

// Of any number of triangles, with and without other faces before and after it.
TEST(Faces, GetMissingNormalsFromTheirTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 4}};
  mesh.colours = {1};
  EXPECT_EQ(mesh.normal_of(0), glm::vec3(-1, 0, 0));
  mesh.add_quad({0, 1, 2, 3}, 2);
  mesh.triangles.emplace_back(0, 4, 1);
  mesh.fill_normals(mesh.triangles.size());
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{-1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(mesh.flags, (std::vector<std::uint8_t>{0, 0, kSameFace}));
}

TEST(Faces, WithTwoSidesAreNeverCulled) {
  const Scene scene = scene_of_quads(true);
  const Mesh& mesh = scene.meshes[0];
  const auto is_two_sided = [&](const ScreenTriangle& t) {
    return mesh.has_flag(t.payload % mesh.triangles.size(), kTwoSided);
  };
  const auto all = run(scene, with(Cull::none, Payload::id)).triangles;
  for (const Cull cull : {Cull::back, Cull::front, Cull::both}) {
    auto expected = all;
    std::erase_if(expected, [&](const ScreenTriangle& t) {
      const bool front = contract::signed_area(t) > 0;
      return !is_two_sided(t) && (cull == Cull::both || (cull == Cull::front) == front);
    });
    const auto found = run(scene, with(cull, Payload::id));
    expect_same_triangles(found.triangles, expected, std::string(name_of(cull)));
    EXPECT_EQ(found.stats.culled, all.size() - expected.size());
  }
}

// A square in front of the camera, lit from the camera's side or from behind.
Scene scene_of_square(bool two_sided, bool turned, glm::vec3 to_light) {
  Mesh mesh;
  mesh.positions = {{-1, 1, -3}, {1, 1, -3}, {1, -1, -3}, {-1, -1, -3}};
  mesh.add_quad(turned ? glm::uvec4{0, 3, 2, 1} : glm::uvec4{0, 1, 2, 3}, rgb(200, 200, 200), two_sided);
  Scene scene = testing::scene_of(std::move(mesh));
  scene.to_light = to_light;
  return scene;
}

std::uint32_t colour_of(const Scene& scene) {
  const auto triangles = run(scene, with(Cull::none)).triangles;
  EXPECT_EQ(triangles.size(), 2u);
  EXPECT_EQ(lit_colours(scene), std::vector<std::uint32_t>(2, triangles.at(0).payload));
  EXPECT_EQ(triangles.at(1).payload, triangles[0].payload);
  return triangles[0].payload;
}

// By matrices too, mirroring or not, although the view's direction has no position.
TEST(Faces, WithTwoSidesAreLitOnTheVisibleSide) {
  for (const float side : {1.0f, -1.0f}) {
    const std::uint32_t shade = side > 0 ? rgb(200, 200, 200) : rgb(30, 30, 30);
    for (const bool turned : {false, true})
      EXPECT_EQ(colour_of(scene_of_square(true, turned, {0, 0, side})), shade);
    EXPECT_EQ(colour_of(scene_of_square(false, side < 0, {0, 0, 1})), shade);
    Scene scene = scene_of_square(true, false, {0, 0, side});
    for (const double mirror : {1.0, -1.0})
      for (const glm::dmat4& projection : {orthographic_projection(-2 * mirror, 2 * mirror, -2, 2, 1, 9),
                                           perspective_projection(1, 1, 1, 9)}) {
        scene.matrices = CameraMatrices{glm::dmat4(1.0), projection};
        colour_of(scene);
      }
  }
}

}  // namespace
}  // namespace edgewise

// Triangles without area draw nothing: points, lines, and triangles that snapping flattens. Slivers draw
// exactly the samples inside them.
#include <glm/glm.hpp>

#include "conformance/pipeline.h"
#include "core/random.h"

namespace edgewise::conformance {
namespace {

class ConformanceDegenerate : public Conformance {
 protected:
  void expect_flat(const std::vector<glm::vec3>& v, const std::string& what) {
    std::vector<glm::uvec3> triangles;
    for (unsigned i = 0; i + 2 < v.size(); i += 3)
      for (const glm::uvec3 order :
           {glm::uvec3(0, 1, 2), glm::uvec3(1, 2, 0), glm::uvec3(2, 0, 1), glm::uvec3(2, 1, 0)})
        triangles.push_back(order + i);
    for (const Cull cull : cull_modes())
      expect_nothing(stream_of(v, triangles), {.cull = cull}, what + ", cull " + std::string(name_of(cull)));
  }
};

TEST_F(ConformanceDegenerate, PointsDrawNothing) {
  std::vector<glm::vec3> v;
  for (const glm::vec2 p : {glm::vec2(0, 0), {31.5f, 31.5f}, {31, 31}, {63.99f, 0.01f}, {-5, 20}, {90, 70}})
    for (int k = 0; k < 3; ++k) v.emplace_back(p, 0.25f * static_cast<float>(k));
  expect_flat(v, "points");
}

TEST_F(ConformanceDegenerate, LinesDrawNothing) {
  std::vector<glm::vec3> v;
  const auto add = [&](glm::vec2 a, glm::vec2 b) {
    v.insert(v.end(), {glm::vec3(a, 0), glm::vec3(b, 1), glm::vec3(a, 1)});  // there and back
    v.insert(v.end(),
             {glm::vec3(a, 0), glm::vec3(0.5f * (a + b), 0.1f), glm::vec3(b, 1)});         // through a middle
    v.insert(v.end(), {glm::vec3(a, 0), glm::vec3(b, 0.1f), glm::vec3(2.0f * b - a, 1)});  // and beyond
  };
  add({0.5f, 10.5f}, {60.5f, 10.5f});  // along a row of samples
  add({7.5f, 0.5f}, {7.5f, 64.5f});
  add({0.5f, 0.5f}, {48.5f, 48.5f});
  add({-100, 3}, {200, 61});
  add({-16000, -8000}, {16000, 8000});
  expect_flat(v, "lines");
}

// Triangles with area in float, whose vertices are collinear or equal after rounding to 1/256 px.
TEST_F(ConformanceDegenerate, TrianglesThatSnappingFlattensDrawNothing) {
  Random random(5);
  std::vector<glm::vec3> v;
  const auto jitter = [&] { return random.uniform(-0.0019f, 0.0019f); };  // less than 1/512 px
  for (int i = 0; i < 200; ++i) {
    const glm::vec2 from(random.below(64), random.below(64)), step(random.below(5), random.below(5));
    for (int k = 0; k < 3; ++k) {
      const glm::vec2 p = from + step * static_cast<float>(k) + glm::vec2(jitter(), jitter());
      v.emplace_back(p, random.uniform(0.0f, 1.0f));
    }
    ASSERT_EQ(area(snapped(std::span(v).last(3))), 0);
  }
  expect_flat(v, "flattened");
}

// Triangles without area that cross every clipping plane: the clipped parts have no area either.
TEST_F(ConformanceDegenerate, ClippedFlatTrianglesDrawNothing) {
  std::vector<glm::vec3> v;
  for (const glm::vec3 d :
       {glm::vec3(1, 0, 0), {0, 1, 0}, {1, 1, 0}, {1, -1, 1}, {-1, 0.5f, 1}, {0.25f, 1, -1}}) {
    const glm::vec3 reach = d * glm::vec3(65536, 65536, 2), middle(32, 32, 0.5f);
    v.insert(v.end(), {middle - reach, middle, middle + reach});
    v.insert(v.end(), {middle - reach, middle + reach, middle - reach});
    v.insert(v.end(), {middle + reach, middle + reach, middle + reach});
  }
  expect_flat(v, "clipped");
}

TEST_F(ConformanceDegenerate, SliversOfOneSubUnitCoverExactlyTheSamplesInside) {
  int drawn = 0;
  for (int offset = -2; offset <= 2; ++offset)
    for (const int height : {1, 2}) {
      const float y = 20.5f + static_cast<float>(offset) / 256.0f;
      const std::vector<glm::vec3> v{
          {1.25f, y, 0.5f}, {62.25f, y, 0.5f}, {30.5f, y + static_cast<float>(height) / 256.0f, 0.5f}};
      const auto expected = windings(snapped(v), 64, 64);
      for (const int turns : expected) drawn += turns;
      expect_hits(stream_of(v, {{0, 1, 2}}), {}, expected, "along a row");
      std::vector<glm::vec3> turned;
      for (const glm::vec3 p : v) turned.emplace_back(p.y, p.x, p.z);
      auto column = windings(snapped(turned), 64, 64);
      for (int& turns : column) turns = -turns;
      expect_hits(stream_of(turned, {{0, 1, 2}}), {}, column, "along a column");
    }
  EXPECT_GT(drawn, 100);
}

// In a mesh seen through a camera, triangles without area between two others change nothing.
TEST_F(ConformanceDegenerate, FlatTrianglesAmongOthersChangeNothing) {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{-2, -2, -4}, {-2, 2, -4}, {2, -2, -4}, {2, 2, -4}, {0, 0, -4}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  mesh.colours = {0, 0};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({});
  Scene with_flat = scene;
  with_flat.meshes[0].triangles.insert(with_flat.meshes[0].triangles.end(),
                                       {{1, 2, 1}, {4, 4, 4}, {1, 4, 2}});
  with_flat.meshes[0].colours.assign(5, 0);
  with_each("seam", [&](Pipeline& pipeline) {
    const auto plain = pipeline.hits(scene, {});
    ASSERT_EQ(pipeline.hits(with_flat, {}), plain);
    ASSERT_EQ(*std::max_element(plain.begin(), plain.end()), 1);
  });
}

}  // namespace
}  // namespace edgewise::conformance

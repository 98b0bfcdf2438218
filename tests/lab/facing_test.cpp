// The facing methods: their promises and their failures, against the exact sign of the projected area.
#include "lab/facing/facing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/random.h"
#include "lab/stage_methods.h"
#include "lab/view_space.h"

namespace edgewise::lab {
namespace {

constexpr auto& method = find_facing_method;
FacingScore judge(std::string_view name, const FacingScene& scene) {
  return score(method(name), scene, facing_facts(scene)).source;
}

TEST(Facing, EveryMethodKeepsItsPromiseAndFailsOnFloatInputSomewhere) {
  std::map<std::string_view, std::uint64_t> wrong;
  for (const auto& c : facing_cases()) {
    const FacingScene scene = c.make();
    const auto facts = facing_facts(scene);
    for (const auto& m : facing_methods()) {
      const auto s = score(m, scene, facts);
      EXPECT_GT(s.source.faces, 0u) << c.name;
      EXPECT_EQ(s.broken, 0u) << m.info.name << " on " << c.name;
      wrong[m.info.name] += s.source.misclassified - s.source.misled;
    }
  }
  for (const auto& m : facing_methods()) EXPECT_GT(wrong[m.info.name], 0u) << m.info.name;
}

// Ours tests the snapped triangle. If it misjudges a face against the float truth, snapping has flipped that
// face, or the polygon's first three vertices have another orientation than the polygon.
TEST(Facing, OursIsTheSignOfTheSnappedAreaOnEveryScene) {
  std::uint64_t turned = 0;
  for (const auto& c : facing_cases()) {
    const FacingScene scene = c.make();
    const auto facts = facing_facts(scene);
    const auto s = score(method("snapped_area"), scene, facts);
    EXPECT_GT(s.snapped.faces, 0u) << c.name;
    EXPECT_EQ(s.snapped.misclassified, s.snapped.misled) << c.name;
    std::uint64_t by_snapping = 0;
    for (const FaceFacts& f : facts)
      by_snapping += f.source.covers_sample && !f.source.first_three_differ &&
                     !f.snapped.first_three_differ && f.source.front != f.snapped.front;
    EXPECT_EQ(s.source.misclassified - s.source.misled, by_snapping) << c.name;
    turned += by_snapping;
  }
  EXPECT_GT(turned, 0u);
}

TEST(Facing, TheErrorRateOfNormalZIsTheTiltOver180Degrees) {
  for (const int degrees : {0, 15, 30, 60}) {
    const double tilt = degrees * 3.141592653589793 / 180;
    // Three standard deviations of a rate measured on 3000 faces.
    const double rate = degrees / 180.0, spread = 3 * std::sqrt(rate * (1 - rate) / 3000);
    // With perspective, normal_z errs; without, rays do.
    for (const bool perspective : {true, false}) {
      const FacingScene scene = tilted_faces(tilt, perspective, 3000, 7);
      const FacingScore s = judge(perspective ? "normal_z" : "normal_dot_eye", scene);
      EXPECT_NEAR(static_cast<double>(s.misclassified) / static_cast<double>(s.faces), rate, spread + 0.01);
      EXPECT_LE(judge(perspective ? "normal_dot_eye" : "normal_z", scene).misclassified, 2u);
    }
  }
}

// Any three vertices determine the orientation of a convex planar polygon. For other polygons, methods by
// areas make additional errors only where the first three vertices have another orientation than the polygon.
// The normal of a planar polygon never misleads.
TEST(Facing, PolygonsAreJudgedByTheirFirstThreeVerticesOrTheirNormal) {
  for (const auto shape : {Shape::regular, Shape::irregular, Shape::bent}) {
    const FacingScene scene = polygons(shape, 2000, 8);
    const auto facts = facing_facts(scene);
    std::uint64_t differing = 0, quads_differing = 0, normals_differing = 0;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!facts[i].source.covers_sample) continue;
      normals_differing += facts[i].normal_differs;
      if (!facts[i].source.first_three_differ) continue;
      ++differing;
      quads_differing += scene.faces[i].count == 4;
      EXPECT_GT(scene.faces[i].count, 3u);
    }
    EXPECT_EQ(differing > 0, shape != Shape::regular);
    EXPECT_EQ(quads_differing > 0, shape != Shape::regular);
    EXPECT_EQ(normals_differing > 2, shape == Shape::bent);
    for (const auto& m : facing_methods()) {
      const auto s = score(m, scene, facts);
      EXPECT_EQ(s.broken, 0u) << m.info.name;
      if (m.info.name == "normal_z" || m.info.name == "normal_dot_object") continue;  // they err by the tilt
      const std::uint64_t misleading = m.by_normal ? normals_differing : differing;
      EXPECT_LE(s.source.misclassified, misleading + 2) << m.info.name;
      EXPECT_LE(s.source.misled, misleading) << m.info.name;
      if (!m.by_normal) {
        EXPECT_GE(s.source.misclassified + 2, differing) << m.info.name;
      }
    }
  }
}

// Of a scene, methods by normals test each face once, by the normal of the whole. Each quad's first triangle
// has no area, or it is folded away from the rest.
TEST(Facing, FacesOfASceneAreTestedOnceByTheirNormal) {
  Random random(4);
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  const auto vector = [&](float z) {
    const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    return glm::vec3(x, y, z + random.uniform(-1, 1));
  };
  for (std::uint32_t i = 0; i < 400; ++i) {
    const glm::vec3 a = vector(-4), c = vector(-4), d = vector(-4), middle = (a + c) * 0.5f;
    mesh.positions.insert(mesh.positions.end(),
                          {a, i % 2 == 0 ? middle : middle + 0.3f * (d - middle), c, d});
    mesh.add_quad({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, i);
  }
  scene.instances.resize(2);
  scene.instances[1].scale = {-1, 2, 0.5f};
  scene.camera.position = {0.2f, 0.1f, 0.5f};
  scene.camera.yaw = 0.1f;
  const ClippingScene seen = in_view_space(scene, {256, 256});
  for (const auto& m : facing_methods()) {
    if (!m.by_normal) continue;
    const auto fronts = fronts_of(m, seen);
    const bool by_ray = m.info.name != "normal_z" && m.info.name != "normal_dot_object";
    for (std::size_t i = 0; i < fronts.size(); i += 2) {
      ASSERT_EQ(fronts[i], fronts[i + 1]) << m.info.name;
      if (!by_ray) continue;
      const glm::vec3* p = &seen.mesh().positions[3 * i];  // a, b, c, and a, c, d
      const glm::dvec3 first(p[0]), third(p[2]), fourth(p[5]);
      const double side = glm::dot(glm::cross(fourth - first, third - first), first);
      if (std::abs(side) > 1e-4) {
        EXPECT_EQ(fronts[i] != 0, side < 0) << m.info.name << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace edgewise::lab

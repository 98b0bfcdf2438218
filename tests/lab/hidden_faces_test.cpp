// Dropping hidden faces by their normals: the faces that remain, and the errors of the picture.
#include "lab/hidden_faces.h"

#include <gtest/gtest.h>

#include "support.h"
#include "viewer/viewer_support.h"

namespace edgewise {
namespace {

const lab::FacingMethod& normal_z() {
  return lab::find_facing_method("normal_z");
}

std::vector<ScreenTriangle> run(const Drawable& drawable, Cull cull) {
  const auto [width, height] = viewer::kTestSize;
  return testing::run(drawable, {.width = width, .height = height, .cull = cull}).triangles;
}

std::vector<ScreenTriangle> left_of(const Scene& scene) {
  lab::HiddenFaces hidden(scene, normal_z());
  return run(hidden.drop(scene), Cull::none);
}

TEST(HiddenFaces, MatchWindingCullingFromFarAway) {
  Scene scene = std::get<Scene>(find_scene("cube").make({}));
  Mesh quads = scene.meshes[0];
  for (int i = 0; i < 12; ++i) quads.flags.push_back(i % 2 == 0 ? 0 : kSameFace);
  scene.meshes.push_back(std::move(quads));
  scene.instances.clear();
  for (int i = 0; i < 8; ++i) {
    const auto n = static_cast<float>(i);
    scene.instances.push_back({.mesh = static_cast<std::size_t>(i % 2),
                               .scale = {i < 4 ? 0.5f : -0.5f, 0.3f + 0.1f * n, 0.6f},
                               .axis = {1.0f, 0.3f * n, -0.4f},
                               .angle = 0.7f + n,
                               .translation = {2.5f * n - 8.75f, 0.2f * n, -n}});
  }
  scene.camera = {.position = {700.0f, 900.0f, 4000.0f}, .fov_y = 0.0036f, .near_z = 1e3f, .far_z = 1e4f};
  scene.camera.look_at({0.0f, 0.0f, 0.0f});
  const auto left = left_of(scene);
  EXPECT_EQ(left.size(), 8u * 6);
  testing::expect_same_triangles(run(scene, Cull::back), left, "by winding");
}

TEST(HiddenFaces, ExceedWindingCullingUnderPerspective) {
  EXPECT_EQ(left_of(viewer::box_aside()).size(), 2u);  // its front; not its left side
  viewer::Session session = viewer::session_of(viewer::box_aside());
  viewer::type(session, "<normal_z>k");
  EXPECT_GT(session.side(0).judgement.value().wrong, 100u);
}

TEST(HiddenFaces, AreFoundByTheirNormalsAndNeverTwoSided) {
  // Each quad is folded along its diagonal: its first triangle, the smaller one, faces another way than its
  // normal.
  Mesh mesh{{{0, 0, 0}, {0.2f, 0.9f, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {}};
  const glm::uvec4 away(0, 1, 2, 3), towards(2, 1, 0, 3);
  mesh.add_quad(towards, 1, false);
  mesh.add_quad(away, 2, false);
  mesh.add_quad(away, 3, true);
  mesh.add_quad(towards, 4, true);
  mesh.triangles.emplace_back(0, 1, 2), mesh.colours.push_back(6), mesh.flags.push_back(0);
  mesh.triangles.emplace_back(2, 1, 0), mesh.colours.push_back(7), mesh.flags.push_back(0);
  mesh.fill_normals(mesh.triangles.size());
  mesh.clusters.resize(1);
  const Scene scene{.meshes = {mesh}, .instances = {{}}, .camera = {}};  // seen along -z
  lab::HiddenFaces hidden(scene, normal_z());
  for (int frame = 0; frame < 2; ++frame) {
    const Mesh& left = std::get<Scene>(hidden.drop(scene)).meshes.at(0);
    EXPECT_EQ(left.colours, (std::vector<std::uint32_t>{1, 1, 3, 3, 4, 4, 6}));
    EXPECT_EQ(left.flags, (std::vector<std::uint8_t>{0, kSameFace, kTwoSided, kTwoSided | kSameFace,
                                                     kTwoSided, kTwoSided | kSameFace, 0}));
    ASSERT_EQ(left.triangles.size(), 7u);
    EXPECT_EQ(left.triangles[1], glm::uvec3(2, 0, 3));
    EXPECT_EQ(left.triangles[2], glm::uvec3(0, 1, 2));
    EXPECT_EQ(left.positions, mesh.positions);
    EXPECT_TRUE(left.clusters.empty());
  }
}

}  // namespace
}  // namespace edgewise

// Meshes far from 0, whose positions are given in double.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "edgewise/draw.h"
#include "edgewise/hash.h"
#include "edgewise/obj_file.h"
#include "frontend/checked_edits.h"
#include "scene/origin.h"
#include "support.h"
#include "temp_dir.h"

namespace edgewise {
namespace {

using testing::scene_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kWidth = 160, kHeight = 120;

// A survey in UTM, a workpiece in ECEF, and a far place that floats hold.
struct Place {
  glm::dvec3 at;
  double size;
};
constexpr Place kPlaces[] = {{{512'345.678, 5'403'210.123, 431.987}, 300.0},
                             {{-2'487'002.881739342, -4'684'683.676570751, 3'529'638.9835389843}, 0.017},
                             {{6e9, -3.3, 1e4}, 2.0}};

std::vector<glm::dvec3> points_at(const Place& place) {
  Random random(11);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 90; ++i) {
    const auto coordinate = [&] { return place.size * double{random.uniform(-0.5f, 0.5f)}; };
    points.push_back(place.at + glm::dvec3{coordinate(), coordinate(), coordinate()});
  }
  return points;
}

Mesh mesh_of(const std::vector<glm::dvec3>& points) {
  Mesh mesh;
  for (unsigned i = 0; i + 2 < points.size(); i += 3) {
    mesh.triangles.emplace_back(i, i + 1, i + 2);
    mesh.colours.push_back(rgb(2 * i, 255 - 2 * i, 99));
  }
  mesh.set_positions(points);
  return mesh;
}

// The camera `from` a point, in the unit of the place's size.
Camera camera_at(const glm::dvec3& point, double size) {
  Camera camera{.position = point + size * glm::dvec3(0.25, 0.5, 2.0)};
  camera.near_z = static_cast<float>(size / 64), camera.far_z = static_cast<float>(size * 64);
  camera.look_at(point);
  return camera;
}

std::uint64_t picture(const Drawable& drawable, Payload payload = Payload::colour) {
  Frontend frontend;
  Framebuffer frame(kWidth, kHeight);
  draw(drawable, frontend, {.width = kWidth, .height = kHeight, .cull = Cull::none, .payload = payload},
       *find_backend("tiled").make(), frame.view(), {9});
  EXPECT_GT(frontend.stats().emitted, 0u);
  return hash_of(frame);
}

void expect_bounds(const Scene& scene, const std::vector<glm::dvec3>& points, double tolerance) {
  Bounds expected = no_box();
  for (const glm::dvec3& point : points) extend(expected, point);
  EXPECT_LT(glm::distance(bounds_of(scene).low, expected.low), tolerance);
  EXPECT_LT(glm::distance(bounds_of(scene).high, expected.high), tolerance);
}

TEST(Origins, AMeshFarAwayIsDrawnAsOneNear0) {
  for (const Place& place : kPlaces) {
    const auto points = points_at(place);
    Scene far = scene_of(mesh_of(points));
    const Mesh& mesh = far.meshes[0];
    EXPECT_LT(glm::distance(mesh.origin, place.at), place.size);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int k = 0; k < 3; ++k)
        EXPECT_LE(std::abs(mesh.origin[k] + double{mesh.positions[i][k]} - points[i][k]),
                  0x1p-24 * place.size)
            << "of the true point";
    far.camera = camera_at(mesh.origin, place.size);  // its difference to the origin is exact
    expect_bounds(far, points, 0x1p-22 * place.size);
    Scene near = far;  // the same mesh, camera and picture, moved to 0 in double
    near.meshes[0].origin = glm::dvec3(0.0), near.camera.position -= far.meshes[0].origin;
    for (const Payload payload : {Payload::colour, Payload::id})
      EXPECT_EQ(picture(far, payload), picture(near, payload)) << place.size;
  }
}

// Wherever an instance moves the true points to.
TEST(Origins, MatricesApplyToTheGivenPoints) {
  for (const Place& place : kPlaces) {
    auto points = points_at(place);
    Scene scene = scene_of(mesh_of(points));
    const glm::dvec3 origin = scene.meshes[0].origin;
    scene.camera = camera_at(glm::dvec3(0.0), place.size);
    glm::dmat4 back(1.0);
    back[3] = glm::dvec4(-origin, 1.0);
    set_instance(scene, 0, back);
    Scene near = scene_of(scene.meshes[0]);
    near.meshes[0].origin = glm::dvec3(0.0), near.camera = scene.camera;
    EXPECT_EQ(picture(scene), picture(near));
    remove_instance(scene, 0);
    add_instance(scene, {.translation = -origin});
    EXPECT_EQ(picture(scene), picture(near));
    // A quarter turn about the world's z axis, and twice the size.
    const glm::dmat4 turned(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1);
    set_instance(scene, 0, turned);
    for (glm::dvec3& point : points) point = turned * glm::dvec4(point, 1.0);
    expect_bounds(scene, points, 0x1p-21 * place.size);
    set_positions(scene, 0, points.size(), [&] { return std::vector<glm::vec3>(points.size()); });
    EXPECT_EQ(scene.meshes[0].origin, glm::dvec3(0.0)) << "floats are true positions, too";
  }
}

TEST(Origins, CodeThatChangesInstancesKeepsTheShape) {
  for (const Place& place : kPlaces) {
    Scene far = scene_of(mesh_of(points_at(place))), near = far;
    near.meshes[0].origin = glm::dvec3(0.0);
    fit(far), fit(near);
    EXPECT_LT(glm::distance(far.instances[0].translation, near.instances[0].translation), 1e-6);
    frame_camera(near);
    far.camera = near.camera, far.instances = near.instances;
    EXPECT_EQ(picture(far), picture(near)) << "fit() leaves no origin";
  }
}

// Points that floats hold, or nearly so, keep the bits of floats.
TEST(Origins, AreZeroWhereFloatsAreEnough) {
  const auto origin_of = [](const std::vector<glm::dvec3>& points) { return mesh_of(points).origin; };
  const glm::dvec3 zero(0.0), far(5e6, 0.25, 0), none(kNan), beyond(1e39, 0, 0);
  EXPECT_EQ(origin_of({}), zero);
  EXPECT_EQ(origin_of({none, none, none}), zero);
  EXPECT_EQ(origin_of({far, far + 1.0, far + 3.0}), zero) << "exact";
  EXPECT_EQ(origin_of({{0.1, 0, 0}, {0, 0.3, 0}, {0, 0, 0.4}}), zero) << "near";
  EXPECT_NE(origin_of({far, far + 0.1, far + 3.0}), zero);
  EXPECT_NE(origin_of({far, far + 0.1, far + 3.0, none, far, far, beyond, far, far}), zero)
      << "points that are not drawn do not count";
  const Mesh mesh = mesh_of({far + 0.1, far + 0.1, far + 0.1, none, beyond, -beyond});
  EXPECT_LT(glm::distance(mesh.origin + glm::dvec3(mesh.positions[0]), far + 0.1), 1e-7) << "a point";
  EXPECT_TRUE(std::isnan(mesh.positions[3].x) && std::isinf(mesh.positions[4].x) &&
              std::isinf(mesh.positions[5].x));
  Mesh points;
  points.set_positions(std::vector{far + 0.1, far + 0.2});
  EXPECT_NE(points.origin, zero) << "without triangles, all count";
}

// Normals of faces and boxes of clusters.
TEST(Origins, NormalsAndClustersAreRenewed) {
  const std::string faces = "f 1 2 3 4\nf 2 1 5\nf 4 3 2 1 5\n";
  const TempDir dir;
  const auto read = [&](const std::string& vertices) {
    return read_obj(dir.write("a.obj", vertices + faces));
  };
  const Scene expected = read("v 7.1 0 0\nv 9 0 1\nv 9 2 1\nv 7 2.5 0\nv 8 0.5 3\n");
  Scene moved = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n");
  EXPECT_NE(moved.meshes[0].normals, expected.meshes[0].normals);
  set_positions(moved, 0, 5, [] {
    return std::vector<glm::dvec3>{{7.1, 0, 0}, {9, 0, 1}, {9, 2, 1}, {7, 2.5, 0}, {8, 0.5, 3}};
  });
  moved.camera = expected.camera;
  EXPECT_EQ(moved.meshes[0].normals, expected.meshes[0].normals);
  EXPECT_EQ(picture(moved), picture(expected));

  std::vector<glm::dvec3> points;  // with clusters
  for (int i = 0; i < 800; ++i)
    for (const glm::dvec3& point : points_at(kPlaces[0])) points.push_back(point + double(i) * 1e-3);
  points.resize(3 * (1 << 16));
  for (std::size_t i = 72'000; i < points.size(); ++i) points[i] = points[i % 72'000];
  Scene large;
  add_mesh(large, mesh_of(points));
  add_instance(large, {});
  ASSERT_FALSE(large.meshes[0].clusters.empty());
  for (glm::dvec3& point : points) point.x += 1e6;
  set_positions(large, 0, points.size(), [&] { return points; });
  large.camera = camera_at(kPlaces[0].at + glm::dvec3(1e6, 0, 0), kPlaces[0].size);
  Scene anew = large;
  anew.meshes[0].clusters.clear();
  EXPECT_EQ(picture(large), picture(anew));
}

}  // namespace
}  // namespace edgewise

// Scenes with matrices in place of the camera, or in place of an instance's scale, rotation and translation
// (rule 10).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/random.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "edgewise/scene.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::run;
using testing::spread;

constexpr int kWidth = 1920, kHeight = 1080;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Real = long double;
using Exact3 = glm::vec<3, Real>;
using Exact4 = glm::vec<4, Real>;
using ExactMatrix = glm::mat<4, 4, Real>;

glm::dmat4 random_turn(Random& random) {
  const glm::dvec3 axis(spread(random, 1), spread(random, 1), 1.0 + double{spread(random, 0.5f)});
  return glm::rotate(glm::dmat4(1.0), double{spread(random, 3)}, axis);
}

constexpr const char* kKinds[] = {"off-centre perspective", "oblique near plane", "perspective in one matrix",
                                  "orthographic",           "oblique parallel",   "warped parallel"};

// Of a kind, seen from `eye`; `distance` is the near plane's, or the size of what a parallel projection sees.
CameraMatrices random_matrices(Random& random, std::size_t kind, glm::dvec3 eye, double distance) {
  const glm::dmat4 view = random_turn(random) * glm::translate(glm::dmat4(1.0), -eye);
  const double left{random.uniform(-1, -0.2f)}, right{random.uniform(0.2f, 1)}, low{random.uniform(-0.5f, 0)},
      high{random.uniform(0.2f, 0.5f)}, d = distance;
  glm::dmat4 perspective = glm::frustumRH_ZO(left * d, right * d, low * d, high * d, d, 50 * d);
  glm::dmat4 parallel = orthographic_projection(left * d, right * d, low * d, high * d, -5 * d, 5 * d);
  switch (kind) {
    case 0:
      return {view, perspective};
    case 1:  // z is the distance from a tilted plane
      perspective[0].z = 0.3, perspective[1].z = 0.1, perspective[2].z = -0.9, perspective[3].z = -0.5 * d;
      return {view, perspective};
    case 2:
      return {glm::dmat4(1.0), perspective * view};
    case 3:
      return {view, parallel};
    case 4:  // x and y change with the distance
      parallel[2].x = 0.4 / d, parallel[2].y = -0.1 / d;
      return {view, parallel};
    default: {  // w grows downwards, as in warped shadow maps
      const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 1.5, glm::dvec3(1, 0, 0));
      return {view, glm::frustumRH_ZO(-0.5, 0.5, -0.5, 0.5, 1.0, 4.0) *
                        glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -2)) * turn * parallel};
    }
  }
}

// Of rule 10, for an instance at `place`. Where several corners of the view volume have the smallest w, all
// of them.
std::vector<Exact3> subtracted_points(const CameraMatrices& m, std::size_t kind, glm::dvec3 place) {
  if (kind == 0) return {Exact3(glm::inverse(ExactMatrix(m.view))[3])};
  const ExactMatrix to_world = glm::inverse(ExactMatrix(m.projection) * ExactMatrix(m.view));
  const auto at = [&](Real x, Real y, Real z) { return to_world * Exact4(x, y, z, 1); };
  const auto point = [](const Exact4& v) { return Exact3(v) / v.w; };
  if (kind == 3 || kind == 4) {
    const Exact3 near_middle = point(at(0, 0, 0)), axis = point(at(0, 0, 1)) - near_middle;
    const Real along = glm::dot(Exact3(place) - near_middle, axis) / glm::dot(axis, axis);
    return {near_middle + std::clamp(along, Real{0}, Real{1}) * axis};
  }
  Real largest = 0;
  for (int corner = 0; corner < 8; ++corner)
    largest = std::max(largest, at(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : 0).w);
  std::vector<Exact3> points;
  for (int corner = 0; corner < 8; ++corner) {
    const Exact4 v = at(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : 0);
    if (v.w > Real{0.999999} * largest) points.push_back(point(v));
  }
  return points;
}

// A triangle in the view volume of the scene's matrices, far from the origin: in the mesh, or by the
// instance. False if a vertex is not in front.
bool add_triangle(Random& random, Scene& scene, glm::dvec3 place) {
  const glm::dmat4 to_world = glm::inverse(scene.matrices->view) * glm::inverse(scene.matrices->projection);
  Mesh& mesh = scene.meshes.emplace_back();
  for (int k = 0; k < 3; ++k) {
    const glm::dvec4 at =
        to_world * glm::dvec4(spread(random, 1), spread(random, 1), random.uniform(0.01f, 0.99f), 1);
    if (at.w <= 0) return false;
    mesh.positions.emplace_back(glm::dvec3(at) / at.w - place);
  }
  mesh.triangles = {{0, 1, 2}};
  mesh.colours = {0};
  scene.instances.push_back({.translation = place});
  return true;
}

TEST(Matrices, PositionsAndDepthsAreWithinTheContractsBounds) {
  Random random(71);
  Frontend frontend;
  std::size_t vertices[std::size(kKinds)] = {};
  for (std::size_t trial = 0; trial < 30'000; ++trial) {
    const std::size_t kind = trial % std::size(kKinds);
    const double distance = std::ldexp(1.0, static_cast<int>(random.below(20)) - 10);
    const double away = random.below(4) == 0 ? 0 : std::ldexp(distance, static_cast<int>(random.below(18)));
    const glm::dvec3 eye = away * glm::dvec3(spread(random, 1), spread(random, 1), spread(random, 1));
    const glm::dvec3 place = random.below(2) == 0 ? glm::dvec3(0.0) : eye;
    Scene scene;
    scene.matrices = random_matrices(random, kind, eye, distance);
    if (!add_triangle(random, scene, place)) continue;
    const auto triangles =
        frontend.run(scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .keep_unsnapped = true});
    if (frontend.stats().clipped != 0 || triangles.empty()) continue;
    const ExactMatrix to_clip = ExactMatrix(scene.matrices->projection) * ExactMatrix(scene.matrices->view),
                      rows = glm::transpose(to_clip);
    const Exact3 row_x(rows[0]), row_y(rows[1]), row_z(rows[2]), row_w(rows[3]);
    const Real length = std::max(glm::length(row_x + row_w) * kWidth / 2,
                                 glm::length(row_w - row_y) * kHeight / 2),
               length_z = glm::length(row_z), length_w = glm::length(row_w);
    for (int k = 0; k < 3; ++k) {
      const Exact3 p = Exact3(scene.meshes[0].positions[static_cast<std::size_t>(k)]) + Exact3(place);
      const Exact4 clip = to_clip * Exact4(p, 1);
      if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
      Real reach = 0, shift = 0;
      for (const Exact3& o : subtracted_points(*scene.matrices, kind, place)) {
        reach = std::max(reach, glm::length(p - o));
        shift = std::max(shift, glm::length(Exact3(place) - o));
      }
      if (shift > 0x1p24L * reach) continue;
      const Real bound = contract::kPositionError * ((length + kWidth * length_w) * reach / clip.w + kWidth);
      const auto [x, y] = std::pair{frontend.unsnapped()[0].x_px[k], frontend.unsnapped()[0].y_px[k]};
      ASSERT_LE(std::abs(Real{x} - kWidth * (clip.x / clip.w + 1) / 2), bound)
          << kKinds[kind] << ", " << trial;
      ASSERT_LE(std::abs(Real{y} - kHeight * (1 - clip.y / clip.w) / 2), bound)
          << kKinds[kind] << ", " << trial;
      ++vertices[kind];
      if (kind == 0) continue;  // rule 6
      const Real depth_bound = 0x1p-23L * (length_z + length_w) * reach / clip.w;
      ASSERT_LE(
          std::abs(triangles[0].z[k] - contract::kDepthHead - contract::kDepthRange * (clip.z / clip.w)),
          contract::kDepthRange * depth_bound + 1)
          << kKinds[kind] << ", " << trial;
    }
  }
  for (std::size_t kind = 0; kind < std::size(kKinds); ++kind)
    EXPECT_GT(vertices[kind], 5000u) << kKinds[kind];
}

// Both are within the contract's bound of the exact position, which is a few sub-units here. Depths of equal
// positions may differ as those of neighbouring floats do.
void expect_nearly_same(const Drawable& a, const Drawable& b, const std::string& what, int sub_units = 1,
                        double depth_units = 512) {
  const FrontendOptions options{.width = 640, .height = 360, .cull = Cull::none, .keep_unsnapped = true};
  const auto one = run(a, options), other = run(b, options);
  ASSERT_GT(one.triangles.size(), 0u) << what;
  ASSERT_EQ(one.triangles.size(), other.triangles.size()) << what;
  for (std::size_t i = 0; i < one.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const ScreenTriangle &s = one.triangles[i], &t = other.triangles[i];
      ASSERT_NEAR(s.x_q15[k], t.x_q15[k], sub_units << Coarse::kSpareBits) << what << ", triangle " << i;
      ASSERT_NEAR(s.y_q15[k], t.y_q15[k], sub_units << Coarse::kSpareBits) << what << ", triangle " << i;
      ASSERT_NEAR(s.z[k], t.z[k], depth_units) << what << ", triangle " << i;
      for (int channel = 0; channel < 32; channel += 8)
        ASSERT_NEAR(s.payload >> channel & 255, t.payload >> channel & 255, 1) << what << ", triangle " << i;
    }
}

TEST(Matrices, OfACameraShowWhatItShows) {
  for (const SceneInfo& info : builtin_scenes()) {
    if (info.stream) continue;
    const std::string name(info.name);
    const Scene scene = std::get<Scene>(info.make({}));
    Scene given = scene;
    given.matrices = matrices_of(scene.camera, 640.0 / 360);
    given.camera = {};  // has no effect
    expect_nearly_same(scene, given, name);
  }
}

TEST(Matrices, DropNothingThatIsFarAwayButInFrontOfAnInfiniteFarPlane) {
  Random random(47);
  Mesh mesh;
  for (unsigned i = 0; i < 2000; ++i) {
    const float z = -std::ldexp(random.uniform(1.0f, 2.0f), 23 + static_cast<int>(random.below(4)));
    for (int k = 0; k < 3; ++k)
      mesh.positions.emplace_back(z * random.uniform(-0.3f, 0.3f), z * random.uniform(-0.3f, 0.3f), z);
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2), mesh.colours.push_back(0);
  }
  Scene scene = testing::scene_of(std::move(mesh));
  scene.matrices = {glm::dmat4(1.0), perspective_projection(1.0, 640.0 / 360, 0.1, kInfinity)};
  Scene product = scene;
  // No usual perspective: its view is not affine.
  std::swap(product.matrices->view, product.matrices->projection);
  for (const SimdTarget target : supported_targets()) {
    const FrontendOptions options{.width = 640, .height = 360, .cull = Cull::none};
    Frontend usual, general;
    const auto size = usual.run(scene, options, {.target = target}).size();
    EXPECT_EQ(general.run(product, options, {.target = target}).size(), size);
    EXPECT_EQ(general.stats().clipped, 0u);
  }
}

// Rectangles of two triangles. One is 4 before the camera, and visible to the right of x = -0.4, where z = 0.
// The other's distance changes with x: from 0 at the left to 10 at the right.
TEST(Matrices, PlanesClipWhereZIsZeroOrW) {
  glm::dmat4 oblique = glm::perspectiveRH_ZO(std::acos(0.0), 2.0, 1.0, 9.0);
  // z = 0.5 x + 0.1 distance - 0.2
  oblique[0].z = 0.5, oblique[1].z = 0.0, oblique[2].z = -0.1, oblique[3].z = -0.2;
  const struct {
    std::vector<glm::vec3> corners;
    glm::dmat4 projection;
    std::uint64_t clipped_near, clipped_far;
    double least_px, most_px, depth_at_100_px, depth_per_px;
  } cases[] = {{{{-3, -3, -4}, {-3, 3, -4}, {3, 3, -4}, {3, -3, -4}}, oblique, 2, 0, 95, 137.5, 0.05, 0.01},
               {{{-1.25f, -0.5f, 0}, {-1.25f, 0.5f, 0}, {1.25f, 0.5f, -10}, {1.25f, -0.5f, -10}},
                orthographic_projection(-2, 2, -1, 1, 1, 9),
                2,
                2,
                50,
                150,
                0.5,
                0.01}};
  for (const auto& c : cases) {
    Scene scene = testing::scene_of({c.corners, {{0, 1, 2}, {0, 2, 3}}, {1, 2}});
    scene.matrices = CameraMatrices{glm::dmat4(1.0), c.projection};
    const auto shown = run(scene, {.width = 200, .height = 100, .cull = Cull::back});
    EXPECT_EQ(shown.stats.clipped_near, c.clipped_near);
    EXPECT_EQ(shown.stats.clipped_far, c.clipped_far);
    double least = 1e9, most = 0;
    for (const ScreenTriangle& t : shown.triangles)
      for (int k = 0; k < 3; ++k) {
        const double px = t.x_q15[k] / double{contract::kPixel_q15};
        least = std::min(least, px), most = std::max(most, px);
        EXPECT_NEAR(contract::depth01(t.z[k]), c.depth_at_100_px + (px - 100) * c.depth_per_px, 1e-6);
      }
    EXPECT_EQ(least, c.least_px);
    EXPECT_NEAR(most, c.most_px, 1 / 256.0);
  }
}

Scene knot_of(const Instance& instance) {
  Scene scene = std::get<Scene>(find_scene("torus-knot").make({}));
  scene.instances[0] = instance;
  return scene;
}

TEST(InstanceMatrices, EqualScaleRotationAndTranslation) {
  const Instance instance{
      .scale = {-0.5, 1.5, 1}, .axis = {1, 2, 3}, .angle = 0.7f, .translation = {0.25, -0.5, 0.125}};
  Scene parts = knot_of(instance), matrix = knot_of({.matrix = model_matrix({}, instance)});
  EXPECT_EQ(bounds_of(parts).low, bounds_of(matrix).low);
  EXPECT_EQ(bounds_of(parts).high, bounds_of(matrix).high);
  parts.matrices =
      matrix.matrices = {matrices_of(parts.camera, 1).view, orthographic_projection(-2, 2, -2, 2, 0, 10)};
  const FrontendOptions options{.width = 320, .height = 240};
  testing::expect_same_triangles(run(parts, options).triangles, run(matrix, options).triangles, "");
  for (Scene* scene : {&parts, &matrix}) {
    fit(*scene);
    frame_camera(*scene);
    EXPECT_FALSE(scene->matrices.has_value());
  }
  expect_nearly_same(parts, matrix, "fitted");
  const glm::dvec3 size = bounds_of(matrix).high - bounds_of(matrix).low;
  EXPECT_NEAR(std::max({size.x, size.y, size.z}), 2.0, 1e-9);
}

// The longest side is a millionth of the distance from the origin, as in survey coordinates.
TEST(Matrices, NoneAreNeededToFitOrFrameWhatIsFarFromTheOrigin) {
  Scene near = knot_of({});
  for (glm::vec3& p : near.meshes[0].positions) p = glm::round(p * 8.0f);  // floats hold them when moved
  Scene far = near;
  for (glm::vec3& p : far.meshes[0].positions) p += glm::vec3(412'348, 0, -5'572'096);
  for (const bool fitted : {false, true}) {
    for (Scene* scene : {&near, &far}) {
      if (fitted) fit(*scene);
      frame_camera(*scene);
    }
    expect_nearly_same(near, far, fitted ? "fitted" : "framed", 1, contract::kDepthRange);
  }
}

// A matrix's columns, sheared, mirrored or flattened, against a mesh whose vertices are already transformed.
TEST(InstanceMatrices, MayShearMirrorAndFlatten) {
  const glm::dmat4 kShear(1, 0, 0, 0, 0.5, 1.25, -0.25, 0, -0.75, 0.25, 1, 0, 0, 0, 0, 1),
      kFlat(1, 0, 0, 0, 0.5, 0, 0.25, 0, -0.75, 0, 1, 0, 0, 0.5, 0, 1),
      kNearlyFlat(1, 0, 0, 0, 0.5, 0x1p-30, 0.25, 0, -0.75, 0, 1, 0, 0, 0.5, 0, 1);
  Scene knot = knot_of({});
  for (glm::vec3& p : knot.meshes[0].positions)
    p = glm::round(p * 64.0f) / 64.0f;  // so that shears are exact
  glm::dmat4 mirror = kShear;
  mirror[0].x = -1;
  for (const glm::dmat4& matrix : {kShear, mirror, kFlat, kNearlyFlat})
    for (const double away : {0.0, 1e6}) {
      const glm::dvec3 by(away, -away, 3 * away);
      Scene expected = knot, given = knot;
      if (matrix == kFlat || matrix == kNearlyFlat) {  // normals of flat triangles differ
        std::ranges::fill(expected.meshes[0].colours, 0u);
        std::ranges::fill(given.meshes[0].colours, 0u);
      }
      for (glm::vec3& p : expected.meshes[0].positions) p = glm::vec3(matrix * glm::dvec4(p, 1));
      expected.instances[0].translation = by;
      given.instances[0].matrix = matrix;
      glm::dvec4& place = (*given.instances[0].matrix)[3];
      place += glm::dvec4(by, 0);
      expected.camera.position += by, given.camera.position += by;
      expect_nearly_same(expected, given, std::to_string(away), 2, 2048);
    }
}

std::string refusal(const CameraMatrices& matrices) {
  Scene scene = knot_of({});
  scene.matrices = matrices;
  return message_of([&] { run(scene, {}); });
}

TEST(Matrices, AreRefusedIfNothingCanBeSeenThroughThem) {
  const glm::dmat4 one(1.0), perspective = perspective_projection(1, 1, 0.1, 100);
  glm::dmat4 infinite(1.0), nan(1.0), flat(1.0);
  infinite[2].y = kInfinity, nan[2].y = std::nan(""), flat[1].y = 0.0;
  const std::pair<CameraMatrices, const char*> cases[] = {
      {{infinite, perspective}, "finite"},
      {{one, nan}, "finite"},
      {{flat, perspective}, "no inverse"},
      {{one, flat}, "no inverse"},
      {{glm::dmat4(0.0), perspective}, "no inverse"},
      {{one, glm::dmat4(1e-200)}, "no inverse"},  // GLM's determinant underflows
      {{one, -perspective}, "w is never positive"},
      {{one, -one}, "w is never positive"},
      {{one, glm::perspectiveRH_ZO(1.0, 1.0, 100.0, 0.1)}, "reversed"},
      {{one, perspective_projection(1, 1, 1e-40, 1)}, "out of the range"},
      {{one, perspective_projection(1, 1, 1e39, 1e40)}, "out of the range"},
      {{one, glm::dmat4(1e-50)}, "out of the range"}};
  for (const auto& [matrices, expected] : cases)
    EXPECT_NE(refusal(matrices).find(expected), std::string::npos) << expected;
  EXPECT_EQ(refusal({one, perspective}), "");
  EXPECT_EQ(refusal({one, perspective_projection(1, 1, 1, 1e40)}), "");
  Random random(48);
  for (int trial = 0; trial < 200; ++trial) {  // of rank 3, but for rounding
    glm::dmat4 view(1.0);
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 3; ++k) view[i][k] = random.uniform(-1.0f, 1.0f);
    view[2] = 0.3 * view[0] + 0.7 * view[1];
    EXPECT_NE(refusal({view, perspective}), "");
    EXPECT_NE(refusal({view, orthographic_projection(-1, 1, -1, 1, 1, 9)}), "");
  }
}

}  // namespace
}  // namespace edgewise

// Rule 10: positions, against exact products of the matrices, and far from the origin.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <variant>
#include <vector>

#include "core/random.h"
#include "edgewise/builtin.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/view.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::spread;

constexpr int kWidth = 1920, kHeight = 1080;
constexpr double kGuardPx = contract::kMaxImageSide;

using Homogeneous = std::array<mpq_class, 4>;

Homogeneous operator*(const glm::dmat4& m, const Homogeneous& v) {
  Homogeneous sum{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      sum[static_cast<std::size_t>(row)] += mpq_class(m[column][row]) * v[static_cast<std::size_t>(column)];
  return sum;
}

Homogeneous as_homogeneous(glm::vec3 position) {
  return {position.x, position.y, position.z, 1};
}

double ratio(const mpq_class& a, const mpq_class& b) {
  return mpq_class(a / b).get_d();
}

// A scene of one instance, its truth, and what rule 10 needs.
struct Case {
  Scene scene;
  std::vector<glm::dmat4> matrices;  // from x, y, z and w in the image to the mesh

  Homogeneous exact(glm::vec3 position) const {
    Homogeneous v = as_homogeneous(position);
    for (std::size_t i = matrices.size(); i-- > 0;) v = matrices[i] * v;
    return v;
  }
  ScreenTransform to_screen() const {
    return {View(scene, kWidth, kHeight, /*fine=*/true), model_matrix(scene.meshes[0], scene.instances[0])};
  }
};

double row_length(const glm::dmat4x3& m, int row) {
  return glm::length(glm::dvec3(m[0][row], m[1][row], m[2][row]));
}

// Of x and y before they are snapped, `distance` and w being the vertex'.
double bound_px(const ScreenTransform& m, double distance, double w) {
  constexpr double kSide = 2 * kGuardPx;
  const double length =
      std::max(row_length(m.exact, 0), row_length(m.exact, 1)) + kSide * row_length(m.exact, 2);
  return contract::kFinePositionError * (length * distance / w + kSide);
}

glm::dvec3 point_within(Random& random, double reach) {
  const auto one = [&] { return reach * double{random.uniform(-1, 1)}; };
  const double x = one(), y = one();
  return {x, y, one()};
}

glm::dmat4 viewport() {
  const double half_w = kWidth / 2.0, half_h = kHeight / 2.0;
  return {half_w, 0, 0, 0, 0, -half_h, 0, 0, 0, 0, 1, 0, half_w, half_h, 0, 1};
}

// Triangles about `distance` before a camera that is up to `away` from the instance's origin. kind 0: a
// Camera, 1: a usual perspective, 2: a parallel projection, 3: a perspective that is multiplied with the
// view.
Case make_case(Random& random, int kind, double away, double distance, double size) {
  Case c;
  Camera& camera = c.scene.camera;
  camera.position = point_within(random, 0x1p20);
  camera.yaw = random.uniform(-3, 3), camera.pitch = random.uniform(-1.5f, 1.5f);
  camera.fov_y = random.uniform(0.01f, 3.0f);
  camera.near_z = static_cast<float>(distance / 100), camera.far_z = static_cast<float>(distance * 100);
  const glm::dvec3 forward(-std::sin(camera.yaw) * std::cos(camera.pitch), std::sin(camera.pitch),
                           -std::cos(camera.yaw) * std::cos(camera.pitch));
  Instance& instance = c.scene.instances.emplace_back();
  instance.axis = point_within(random, 1), instance.angle = random.uniform(-3, 3);
  instance.translation = camera.position + point_within(random, away);
  Mesh& mesh = c.scene.meshes.emplace_back();
  const glm::dmat4 model = model_matrix(mesh, instance);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 world = camera.position + distance * forward + point_within(random, size);
    mesh.positions.emplace_back(glm::inverse(model) * glm::dvec4(world, 1.0));
  }
  mesh.triangles = {{0, 1, 2}};
  mesh.colours = {0};
  if (kind == 0) {
    const View view(camera, kWidth, kHeight);
    glm::dmat4 rows(0.0);
    for (int i = 0; i < 3; ++i)
      rows[i] = glm::dvec4(view.pixels[i].x, view.pixels[i].y, 0.0, view.pixels[i].z);
    c.matrices = {rows, glm::translate(glm::dmat4(1.0), -camera.position), model};
  } else {
    CameraMatrices m = matrices_of(camera, double{kWidth} / kHeight);
    if (kind == 2)
      m.projection = orthographic_projection(-2 * distance, distance, -distance, distance, 0.01 * distance,
                                             100 * distance);
    if (kind == 3) m = {glm::dmat4(1.0), m.projection * m.view};
    c.scene.matrices = m;
    c.matrices = {viewport(), m.projection, m.view, model};
  }
  return c;
}

TEST(FinePositions, AreWithinTheContractsBound) {
  Random random(71);
  Frontend frontend;
  for (int kind = 0; kind < 4; ++kind) {
    int vertices = 0, drawn = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      const double distance = std::ldexp(1.0, static_cast<int>(random.below(20)) - 10);
      const double away = std::ldexp(distance, static_cast<int>(random.below(24)));
      const double size = std::ldexp(distance, -static_cast<int>(random.below(8)));
      const Case c = make_case(random, kind, away, distance, size);
      const ScreenTransform to_screen = c.to_screen();
      const auto triangles = frontend.run(
          c.scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .subpixel_bits = 15});
      const bool is_drawn = frontend.stats().clipped == 0 && !triangles.empty();
      for (int k = 0; k < 3; ++k) {
        const glm::vec3 position = c.scene.meshes[0].positions[static_cast<std::size_t>(k)];
        const Homogeneous v = c.exact(position);
        if (v[3] <= 0) continue;
        const mpq_class x = v[0] / v[3], y = v[1] / v[3];
        if (abs(x) > kGuardPx || abs(y) > kGuardPx) continue;
        const double reach = glm::distance(glm::dvec3(position), to_screen.origin);
        if (glm::length(to_screen.origin) > 0x1p24 * reach) continue;
        const double bound = bound_px(to_screen, reach, v[3].get_d());
        ASSERT_LT(kind < 3 ? bound : 0.0, 0x1p-17);
        const ClipVertex found = to_screen(position);
        const double inverse_w = 1.0 / found.w;
        ASSERT_LT(std::abs(ratio(mpq_class(found.x * inverse_w) - x, 1)), bound) << kind << ", " << trial;
        ASSERT_LT(std::abs(ratio(mpq_class(found.y * inverse_w) - y, 1)), bound) << kind << ", " << trial;
        ++vertices;
        if (!is_drawn) continue;
        const double half_step = 0x1p-16;
        ASSERT_LE(std::abs(ratio(mpq_class(triangles[0].x_q15[k]) * 0x1p-15 - x, 1)), half_step + bound)
            << kind;
        ASSERT_LE(std::abs(ratio(mpq_class(triangles[0].y_q15[k]) * 0x1p-15 - y, 1)), half_step + bound)
            << kind;
        ++drawn;
      }
    }
    EXPECT_GT(vertices, 4000) << kind;
    EXPECT_GT(drawn, 1000) << kind;
  }
}

// The distance, in px, of a point on the grid from the line through two vertices; infinite if they give none.
double distance_px(std::int32_t x_q15, std::int32_t y_q15, const Homogeneous& a, const Homogeneous& b) {
  const mpq_class u = a[1] * b[3] - a[3] * b[1], v = a[3] * b[0] - a[0] * b[3], w = a[0] * b[1] - a[1] * b[0];
  const mpq_class at = (u * x_q15 + v * y_q15) / (1 << contract::kFineBits) + w;
  const mpq_class largest = std::max(mpq_class(abs(u)), mpq_class(abs(v)));
  if (largest == 0) return std::numeric_limits<double>::infinity();
  return std::abs(ratio(at, largest)) / std::hypot(ratio(u, largest), ratio(v, largest));
}

// New vertices lie on their edges, or on the guard band's border.
TEST(FinePositions, OfNewVerticesLieOnTheirEdges) {
  Random random(72);
  Frontend frontend;
  for (int kind = 0; kind < 4; ++kind) {
    int on_edges = 0, on_border = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Case c = make_case(random, kind, 1.0, 1.0, std::ldexp(1.0, static_cast<int>(random.below(9))));
      const auto& positions = c.scene.meshes[0].positions;
      const Homogeneous corners[] = {c.exact(positions[0]), c.exact(positions[1]), c.exact(positions[2])};
      const auto triangles = frontend.run(
          c.scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .subpixel_bits = 15});
      if (frontend.stats().clipped == 0) continue;
      for (const ScreenTriangle& t : triangles)
        for (int k = 0; k < 3; ++k) {
          if (std::max(std::abs(t.x_q15[k]), std::abs(t.y_q15[k])) == contract::kGuard_q15) {
            ++on_border;
            continue;
          }
          double least = std::numeric_limits<double>::infinity();
          for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}})
            least = std::min(least, distance_px(t.x_q15[k], t.y_q15[k], corners[i], corners[j]));
          ASSERT_LT(least, std::hypot(0x1p-16, 0x1p-16) + 0x1p-17) << kind << ", " << trial;
          ++on_edges;
        }
    }
    EXPECT_GT(on_edges, 1000) << kind;
    EXPECT_GT(on_border, 100) << kind;
  }
}

// With 8 subpixel bits, which floats transform.
TEST(Positions, OfACameraAreWithinTheContractsBoundHoweverFarTheOriginIs) {
  Random random(61);
  Frontend frontend;
  int vertices = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double distance = std::ldexp(1.0, static_cast<int>(random.below(20)) - 10);
    const double away = std::ldexp(distance, static_cast<int>(random.below(24)));
    const Case c = make_case(random, 0, away, distance, 0.3 * distance);
    frontend.run(c.scene, {.width = kWidth, .height = kHeight, .cull = Cull::none, .keep_unsnapped = true});
    if (frontend.stats().clipped != 0 || frontend.unsnapped().empty()) continue;
    const double focal = kHeight / 2.0 / std::tan(double{c.scene.camera.fov_y} / 2);
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 position = c.scene.meshes[0].positions[static_cast<std::size_t>(k)];
      const Homogeneous v = c.exact(position);
      const mpq_class x = v[0] / v[3], y = v[1] / v[3];
      if (x < 0 || x > kWidth || y < 0 || y > kHeight) continue;
      const Homogeneous from_camera = c.matrices[1] * (c.matrices[2] * as_homogeneous(position));
      const double d = std::hypot(from_camera[0].get_d(), from_camera[1].get_d(), from_camera[2].get_d());
      const double bound = contract::kPositionError * (focal + 2 * kWidth) * d / v[3].get_d();
      const UnsnappedTriangle& t = frontend.unsnapped()[0];
      ASSERT_LT(std::abs(ratio(mpq_class(double{t.x_px[k]}) - x, 1)), bound) << trial;
      ASSERT_LT(std::abs(ratio(mpq_class(double{t.y_px[k]}) - y, 1)), bound) << trial;
      ++vertices;
    }
  }
  EXPECT_GT(vertices, 2000);
}

// A floor below the camera whose corners are up to 2^30 times farther away than what is seen of it. Of a new
// vertex on the near plane, w is known.
TEST(Positions, OfNewVerticesHardlyDependOnTheCornersDistance) {
  Random random(62);
  Frontend frontend;
  int vertices = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const float reach = std::ldexp(1.0f, 4 + static_cast<int>(random.below(27)));
    Scene scene =
        testing::scene_of({{{-reach, 0, -reach}, {reach, 0, -reach}, {0, 0, 2 * reach}}, {{0, 1, 2}}, {0}});
    Camera& camera = scene.camera;
    camera.position = {spread(random, 3), 1.0, spread(random, 3)};
    camera.yaw = spread(random, 3), camera.pitch = random.uniform(-0.6f, -0.2f);
    camera.near_z = 1.0f, camera.far_z = 1000.0f;
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
    const double yaw{camera.yaw}, pitch{camera.pitch};
    const glm::dvec3 right(std::cos(yaw), 0, -std::sin(yaw));
    const glm::dvec3 forward(-std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                             -std::cos(yaw) * std::cos(pitch));
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
    before_near += glm::dot(glm::dvec3(a) - camera.position, forward) < double{camera.near_z};
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

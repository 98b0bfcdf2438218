// Rule 10 with more than 8 subpixel bits, against exact products of the matrices.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/view.h"

namespace edgewise {
namespace {

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

double ratio(const mpq_class& a, const mpq_class& b) {
  return mpq_class(a / b).get_d();
}

// A scene of one instance, its truth, and what rule 10 needs.
struct Case {
  Scene scene;
  std::vector<glm::dmat4> matrices;  // from x, y, z and w in the image to the mesh

  Homogeneous exact(glm::vec3 position) const {
    Homogeneous v{position.x, position.y, position.z, 1};
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

glm::dvec3 spread(Random& random, double reach) {
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
  camera.position = spread(random, 0x1p20);
  camera.yaw = random.uniform(-3, 3), camera.pitch = random.uniform(-1.5f, 1.5f);
  camera.fov_y = random.uniform(0.01f, 3.0f);
  camera.near_z = static_cast<float>(distance / 100), camera.far_z = static_cast<float>(distance * 100);
  const glm::dvec3 forward(-std::sin(camera.yaw) * std::cos(camera.pitch), std::sin(camera.pitch),
                           -std::cos(camera.yaw) * std::cos(camera.pitch));
  Instance& instance = c.scene.instances.emplace_back();
  instance.axis = spread(random, 1), instance.angle = random.uniform(-3, 3);
  instance.translation = camera.position + spread(random, away);
  Mesh& mesh = c.scene.meshes.emplace_back();
  const glm::dmat4 model = model_matrix(mesh, instance);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 world = camera.position + distance * forward + spread(random, size);
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

}  // namespace
}  // namespace edgewise

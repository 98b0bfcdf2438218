// A vertex's depth is the depth of its float view distance, on every SIMD target and after clipping.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/fixed.h"
#include "frontend/transform.h"
#include "frontend/view.h"
#include "support.h"

namespace edgewise {
namespace {

// far (w - near) / ((far - near) w), clamped to near … far, in contract units.
mpq_class exact_units(double near_z, double far_z, double w) {
  const mpq_class n(near_z), f(far_z), at(std::clamp(w, near_z, far_z));
  return f * (at - n) / ((f - n) * at) * contract::kDepthRange + contract::kDepthHead;
}

struct Planes {
  float near_z, far_z;
};

// From usual planes to extreme ones: a factor of 10^30 apart, and neighbouring floats.
std::vector<Planes> planes() {
  std::vector<Planes> all{
      {0.1f, 1000.0f},   {0.5f, 200.0f}, {1e-20f, 1e10f}, {1e30f, 3e38f}, {1.0f, std::nextafter(1.0f, 2.0f)},
      {100.0f, 100.001f}};
  Random random(51);
  for (int i = 0; i < 200; ++i) {
    const float near_z = std::pow(10.0f, random.uniform(-6.0f, 4.0f));
    all.push_back({near_z, near_z * (1 + std::pow(10.0f, random.uniform(-6.0f, 8.0f)))});
  }
  return all;
}

// Both planes, their neighbours, distances beyond them, and random ones between them that are spread evenly
// over the depths or over the exponents.
std::vector<float> distances(const Planes& p, std::size_t count) {
  std::vector<float> all{p.near_z,
                         p.far_z,
                         std::nextafter(p.near_z, p.far_z),
                         std::nextafter(p.far_z, p.near_z),
                         1e-45f,
                         0.999f * p.near_z,
                         3.4e38f};
  Random random(52);
  const double n{p.near_z}, f{p.far_z};
  while (all.size() < count) {
    const double share{random.uniform(0.0f, 1.0f)};
    const double w = all.size() % 2 == 0 ? n * std::pow(f / n, share) : n * f / (f - share * (f - n));
    all.push_back(std::clamp(static_cast<float>(w), p.near_z, p.far_z));
  }
  return all;
}

double worst_error(const Planes& p, const std::vector<float>& w, const std::vector<std::uint32_t>& units) {
  double worst = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const mpq_class error = exact_units(double{p.near_z}, double{p.far_z}, double{w[i]}) - units[i];
    worst = std::max(worst, std::abs(error.get_d()));
  }
  return worst;
}

// Half a unit for the rounding, and the bound of ViewDepth's errors in double.
constexpr double kBound = 0.5 + 0x1p-19;

TEST(ViewDepth, IsTheNearestToTheExactDepthOfTheDistance) {
  for (const Planes& p : planes()) {
    const ViewDepth depth(double{p.near_z}, double{p.far_z});
    const std::vector<float> w = distances(p, 1000);
    std::vector<std::uint32_t> units;
    for (const float distance : w) units.push_back(depth.units(distance));
    EXPECT_LE(worst_error(p, w, units), kBound) << p.near_z << " to " << p.far_z;
    EXPECT_EQ(units[0], contract::kDepthHead);
    EXPECT_EQ(units[1], contract::kDepthHead + contract::kDepthRange);
  }
}

TEST(ViewDepth, IsTheSameInEveryKernel) {
  const FrontendOptions options;
  ScreenTransform w_is_x({Camera{}, 1, 1}, glm::dmat4(1.0));
  w_is_x.rounded = glm::mat4x3(0.0f);
  w_is_x.rounded[0] = {0.0f, 0.0f, 1.0f};
  for (const Planes& p : planes()) {
    const ViewDepth depth(double{p.near_z}, double{p.far_z});
    const std::vector<float> w = distances(p, 101);
    Mesh mesh;
    for (const float distance : w) mesh.positions.emplace_back(distance, 0.0f, 0.0f);
    std::vector<Vertex> vertices(w.size());
    const MeshTask task{options, mesh, {1, 1, p.near_z, p.far_z}, w_is_x, depth};
    for (const SimdTarget target : supported_targets()) {
      transform_kernel(target)(task, mesh.positions.data(), w.size(), vertices.data());
      for (std::size_t i = 0; i < w.size(); ++i) {
        if (vertices[i].outside != 0) continue;  // 1 / w overflows
        ASSERT_EQ(vertices[i].z, depth.units(double{w[i]})) << name_of(target) << ", w = " << w[i];
      }
    }
  }
}

// Of walls that reach beyond the guard band.
TEST(ViewDepth, OfAClippedVertexIsThatOfItsDistanceToo) {
  Frontend frontend;
  Scene scene = testing::scene_of({{}, {{0, 1, 2}}, {0}});
  const Planes planes{scene.camera.near_z, scene.camera.far_z};
  std::uint64_t clipped = 0;
  for (const float w : distances(planes, 1000)) {
    const float reach = 1e3f * w;
    scene.meshes[0].positions = {{-reach, -reach, -w}, {0, reach, -w}, {reach, -reach, -w}};
    const double exact = exact_units(double{planes.near_z}, double{planes.far_z}, double{w}).get_d();
    for (const ScreenTriangle& t : frontend.run(scene, {.width = 64, .height = 64, .cull = Cull::none}))
      for (const std::uint32_t z : t.z) ASSERT_NEAR(z, exact, 0.51) << w;
    clipped += frontend.stats().clipped;
  }
  EXPECT_GT(clipped, 900u);
}

}  // namespace
}  // namespace edgewise

// A vertex's depth is the depth of its float view distance, on every SIMD target and after clipping.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/clip.h"
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

// A triangle that reaches beyond the near and far planes and the guard band.
Scene scene_to_clip(Random& random) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (int i = 0; i < 3; ++i) {
    const float distance = std::pow(10.0f, random.uniform(-2.0f, 4.0f));
    mesh.positions.emplace_back(random.uniform(-60.0f, 60.0f) * distance,
                                random.uniform(-60.0f, 60.0f) * distance, i == 0 ? distance : -distance);
  }
  mesh.triangles = {{0, 1, 2}};
  mesh.colours = {0};
  scene.instances.push_back({});
  scene.camera.far_z = 1000.0f;
  return scene;
}

TEST(ViewDepth, OfAClippedVertexIsThatOfItsDistanceToo) {
  Random random(53);
  constexpr int kSide = 64;
  const FrontendOptions options{.width = kSide, .height = kSide, .cull = Cull::none};
  Frontend frontend;
  std::size_t large_depths = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Scene scene = scene_to_clip(random);
    const Camera& camera = scene.camera;
    const ScreenTransform to_screen({camera, kSide, kSide}, glm::dmat4(1.0));
    const ViewVolume view = view_volume(camera, kSide, kSide);
    ClipVertex corner[3];
    std::uint16_t sides = 0;
    for (int i = 0; i < 3; ++i) {
      corner[i] = to_screen(scene.meshes[0].positions[static_cast<std::size_t>(i)]);
      sides |= outside_of(corner[i], view);
    }
    std::set<std::uint32_t> allowed;
    Clipper clipper;
    for (const ClipVertex& v : clipper.clip(corner, sides & kMustClip, view)) {
      const mpq_class exact = exact_units(double{camera.near_z}, double{camera.far_z}, v.w);
      const mpz_class below = exact.get_num() / exact.get_den();
      const auto unit = static_cast<std::uint32_t>(below.get_ui());
      allowed.insert({unit, unit + 1});
    }
    for (const ScreenTriangle& t : frontend.run(scene, options))
      for (const std::uint32_t z : t.z) {
        ASSERT_TRUE(allowed.contains(z)) << "trial " << trial;
        large_depths += z > contract::kDepthHead + contract::kDepthRange / 2;
      }
  }
  EXPECT_GT(large_depths, 1000u) << "few depths are large enough for a float z / w to differ";
}

}  // namespace
}  // namespace edgewise

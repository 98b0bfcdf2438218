// Rule 11 of the contract: barycentric coordinates and distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/hash.h"
#include "lab/cases/random_cases.h"
#include "lab/cases/to_stream.h"
#include "message_of.h"
#include "queries/exact_barycentrics.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::kInfinity, testing::Planes, testing::Shown, testing::Truth;

double error_of(float value, const mpq_class& exact) {
  return mpq_class(abs(mpq_class(value) - exact)).get_d();
}

struct Counts {
  int pixels = 0, clipped = 0, tiny = 0;  // tiny: u is positive but rounds to 0
  double most_by_w = 0.0;                 // the largest error of u by that of w, over its bound
};

// Compares pixels with the truth: of each `step`, one.
void expect_rule(const Shown& shown, const std::string& what, Counts& counts, std::size_t step = 1) {
  const Planes planes = shown.planes();
  Truth truth(shown);
  shown.for_each_pixel([&](int x, int y, std::size_t pixel) {
    if (pixel % step != 0) return;
    const float u = planes.uv[2 * pixel], v = planes.uv[2 * pixel + 1], distance = planes.distance[pixel];
    if (!shown.has(x, y)) {
      ASSERT_TRUE(u == 0.0f && v == 0.0f && distance == kInfinity) << what;
      return;
    }
    const auto where = [&] { return what + ", " + std::to_string(x) + ", " + std::to_string(y); };
    const auto exact = truth.at(x, y);
    ASSERT_TRUE(exact) << where();
    const bool scene = std::holds_alternative<Scene>(shown.drawable);
    const double size = scene ? exact->distance.get_d() : 1.0,
                 true_size = scene ? exact->true_distance.get_d() : 1.0, e = exact->w_error,
                 most = contract::kBarycentricError;
    for (const auto& [value, exactly, bound] :
         {std::tuple(u, exact->u, most), std::tuple(v, exact->v, most),
          std::tuple(distance, exact->distance, contract::kDistanceError * size),
          std::tuple(u, exact->true_u, most + e / 2), std::tuple(v, exact->true_v, most + e / 2),
          std::tuple(distance, exact->true_distance, (contract::kDistanceError + e) * true_size)})
      ASSERT_LT(error_of(value, exactly), bound) << where();
    if (exact->w_error > 0.0) {
      const double by_w = mpq_class(abs(mpq_class(exact->u - exact->true_u))).get_d();
      counts.most_by_w = std::max(counts.most_by_w, by_w / (exact->w_error / 2));
    }
    ASSERT_GE(u, 0.0f) << where();
    ASSERT_GE(v, 0.0f) << where();
    ASSERT_LE(u + v, 1.0f) << where();
    // Floats hold all three weights exactly, in any order of operations.
    ASSERT_EQ(double{1.0f - u - v}, 1.0 - double{u} - double{v}) << where();
    ASSERT_EQ(double{1.0f - (u + v)}, 1.0 - double{u} - double{v}) << where();
    ++counts.pixels;
    counts.clipped += exact->clipped;
    counts.tiny += exact->u != 0 && u == 0.0f;
  });
}

TEST(Barycentrics, AreWithinTheContractsErrorInRandomScenesAndStreams) {
  const auto families = randomized::scene_families();
  for (std::size_t family = 0; family < families.size(); ++family) {
    Counts counts;
    const std::uint64_t trials = testing::full_size() ? 400 : 40;
    for (std::uint64_t trial = 0; trial < trials; ++trial) {
      Random random(1000 * family + trial);
      const int width = testing::between(random, 1, 60), height = testing::between(random, 1, 60);
      const Drawable drawable = families[family].make(random, width, height);
      const Cull cull = cull_modes()[random.below(3)];
      expect_rule(Shown(drawable, {.width = width, .height = height, .cull = cull}),
                  std::string(families[family].name) + " " + std::to_string(trial), counts);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.pixels, 3000) << families[family].name;
    EXPECT_GT(counts.clipped, 300) << families[family].name;
  }
}

TEST(Barycentrics, AreWithinTheContractsErrorInHardStreams) {
  for (const auto family : testing::kFamilies) {
    Counts counts;
    constexpr int kSize = 70;
    const auto triangles = testing::adversarial(family, 200, kSize, kSize, 48);
    expect_rule(
        Shown(lab::to_stream(triangles, kSize, kSize), {.width = kSize, .height = kSize, .cull = Cull::none}),
        std::string(family), counts);
    if (HasFatalFailure()) return;
    EXPECT_GT(counts.pixels, 0) << family;
  }
}

// A floor that reaches from before the near plane far away, with w up to 2^30 times as large.
TEST(Barycentrics, AreWithinTheContractsErrorAtExtremeDepths) {
  Counts counts;
  for (const float length : {1e2f, 1e5f, 1e9f}) {
    Scene scene;
    scene.meshes.push_back({{{-1, -1, 0.5f}, {-1, -1, -length}, {length, -1, -length}, {3, -1, 0.5f}},
                            {{0, 1, 2}, {0, 2, 3}},
                            {0, 0}});
    scene.instances.emplace_back();
    scene.camera.near_z = 0.01f, scene.camera.far_z = 1e10f;
    for (const float pitch : {-1.5f, -0.5f, -0.01f}) {
      scene.camera.pitch = pitch;
      expect_rule(Shown(scene, {.width = 64, .height = 64, .cull = Cull::none}), std::to_string(length),
                  counts);
    }
  }
  EXPECT_GT(counts.clipped, 3000);
  EXPECT_GT(counts.tiny, 0);
}

// Triangles of any shape and place in the view, whose w are up to 2^12 times as large as others', seen by
// cameras up to 2^20 sizes away from the mesh's origin, also by matrices.
TEST(Barycentrics, AreWithinTheErrorOfWForManyCameras) {
  Counts counts;
  Random random(29);
  for (int trial = 0; trial < (testing::full_size() ? 2000 : 150); ++trial) {
    Scene scene;
    Camera& camera = scene.camera;
    camera.fov_y = random.uniform(0.02f, 3.0f);
    camera.yaw = random.uniform(-3, 3), camera.pitch = random.uniform(-1.5f, 1.5f);
    camera.near_z = 0.01f, camera.far_z = 1e5f;
    const double away = std::ldexp(1.0, testing::between(random, -4, 20));
    for (int i = 0; i < 3; ++i) camera.position[i] = away * double{random.uniform(-1, 1)};
    const glm::dmat3 to_world = glm::transpose(to_camera_frame(camera));
    const double up = std::tan(double{camera.fov_y} / 2);
    Mesh& mesh = scene.meshes.emplace_back();
    for (unsigned i = 0; i < 24; ++i) {
      const double w = std::ldexp(1.0, testing::between(random, -2, 10)) * double{random.uniform(1, 2)};
      const glm::dvec3 seen(w * up * double{random.uniform(-1.2f, 1.2f)},
                            w * up * double{random.uniform(-1.2f, 1.2f)}, -w);
      mesh.positions.emplace_back(camera.position + to_world * seen);
      if (i % 3 == 0) mesh.triangles.emplace_back(i, i + 1, i + 2), mesh.colours.push_back(0);
    }
    scene.instances.emplace_back();
    if (trial % 2 == 1) scene.matrices = matrices_of(camera, 1.0);
    expect_rule(Shown(scene, {.width = 40, .height = 40, .cull = Cull::none}), std::to_string(trial), counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.pixels, 50'000);
  EXPECT_GT(counts.most_by_w, 0.05)
      << "of the bound: the cases are hard enough to find a bound that is much too small";
}

TEST(Barycentrics, AreTheSameOnEveryTargetAndThreadCount) {
  for (const auto& family : randomized::scene_families()) {
    Random random(7);
    Shown shown(family.make(random, 150, 90), {.width = 150, .height = 90, .cull = Cull::none});
    const Planes expected = shown.planes();
    for (const int threads : {2, 3, 8}) EXPECT_TRUE(shown.planes(threads) == expected) << family.name;
    for (const SimdTarget target : supported_targets())
      EXPECT_TRUE(shown.planes(1, target) == expected) << family.name << ", " << name_of(target);
    const FrameView ids = shown.ids.view();  // the same, with ids that begin at 9
    for (int y = 0; y < ids.height; ++y)
      for (int x = 0; x < ids.width; ++x) ids.payload[y * ids.stride + x] += 9;
    shown.options.first_id = 9;
    EXPECT_TRUE(shown.planes() == expected) << family.name;
  }
}

// More visible triangles than the cache holds, so that some are made again.
TEST(Barycentrics, ManyTrianglesHaveTheCoordinatesOfEachAlone) {
  const Shown shown(find_scene("sphere").make({}), {.width = 500, .height = 500});
  Counts counts;
  expect_rule(shown, "sphere", counts, 17);
  EXPECT_GT(visible_triangles(shown.ids).size(), 10'000u);
  EXPECT_GT(counts.pixels, 3000);
}

// By a pixel's depth, even where both cover the same pixels.
TEST(Barycentrics, FindFramesOfOtherSubpixelBits) {
  int found = 0;
  for (const auto& family : randomized::scene_families()) {
    Random random(3);
    Shown shown(family.make(random, 90, 60), {.width = 90, .height = 60, .cull = Cull::none});
    for (const int bits : {4, 7, 9, 15}) {
      shown.options.subpixel_bits = bits;
      const bool differs =
          hash_of(shown.ids.view()) != hash_of(Shown(shown.drawable, shown.options).ids.view());
      EXPECT_EQ(
          message_of([&] { shown.planes(); }).find("does not cover it at its depth") != std::string::npos,
          differs)
          << family.name << ' ' << bits;
      found += differs;
    }
  }
  EXPECT_GE(found, 12);
}

// A triangle in the middle of the image, and one that the camera does not see.
Scene two_triangles() {
  Scene scene;
  scene.meshes.push_back(
      {{{-1, -1, -3}, {-1, 1, -3}, {1, -1, -3}, {0, 0, 9}}, {{0, 1, 2}, {3, 3, 3}}, {0, 0}});
  scene.instances.emplace_back();
  return scene;
}

TEST(Barycentrics, WritesOnlyRowsAndPlanesOfTheView) {
  const Shown shown(two_triangles(), {.width = 40, .height = 30});
  const Planes expected = shown.planes();
  std::vector<float> uv(100 * 30, -7.0f), distance(50 * 30, -7.0f);
  barycentrics(shown.ids, shown.drawable, shown.options, {uv.data(), 100});
  barycentrics(shown.ids, shown.drawable, shown.options, {nullptr, 0, distance.data(), 50});
  for (std::size_t y = 0; y < 30; ++y) {
    EXPECT_EQ(std::memcmp(&uv[100 * y], &expected.uv[80 * y], 80 * sizeof(float)), 0);
    EXPECT_EQ(std::memcmp(&distance[50 * y], &expected.distance[40 * y], 40 * sizeof(float)), 0);
    EXPECT_EQ(std::count(&uv[100 * y], &uv[100 * y] + 100, -7.0f), 20);
    EXPECT_EQ(std::count(&distance[50 * y], &distance[50 * y] + 50, -7.0f), 10);
  }
}

TEST(Barycentrics, RejectsWhatDoesNotFit) {
  const Shown shown(two_triangles(), {.width = 40, .height = 30});
  std::vector<float> uv(80 * 30, -7.0f), distance(40 * 30, -7.0f);
  struct Call {
    ConstFrameView ids;
    Drawable drawable;
    FrontendOptions options;
    BarycentricsView out;
    Execution execution = {};
  };
  const auto message = [&](auto&& change) {
    Call call{shown.ids, shown.drawable, shown.options, {uv.data(), 80, distance.data(), 40}};
    change(call);
    return message_of([&] { barycentrics(call.ids, call.drawable, call.options, call.out, call.execution); });
  };
  const auto scene = [](Call& call) -> Scene& { return std::get<Scene>(call.drawable); };
  using Change = std::function<void(Call&)>;
  const std::pair<Change, std::string> kRefused[] = {
      {[](Call& c) { c.options.width = 41; }, "options for 41 x 30 px"},
      {[](Call& c) { c.options.payload = Payload::colour; }, "Payload::id"},
      {[](Call& c) { c.execution.threads = 0; }, "0 threads"},
      {[](Call& c) { c.ids.depth = nullptr; }, "stride 48, cannot be read"},
      {[](Call& c) { c.ids.payload = nullptr; }, "no payload"},
      {[](Call& c) { c.out.uv = c.out.distance = nullptr; }, "both planes are null"},
      {[](Call& c) { c.out.uv_stride = 79; }, "a row's floats"},
      {[&](Call& c) { scene(c).instances[0].mesh = 1; }, "mesh 1 of 1"},
      {[&](Call& c) { scene(c).meshes[0].flags = {0}; }, "1 flags"},
      {[&](Call& c) { scene(c).camera.near_z = 0; }, "0 < near < far"}};
  for (const auto& [change, said] : kRefused)
    EXPECT_NE(message(change).find(said), std::string::npos) << message(change);
  EXPECT_EQ(std::count(uv.begin(), uv.end(), -7.0f), 80 * 30) << "written before an error";
  EXPECT_EQ(std::count(distance.begin(), distance.end(), -7.0f), 40 * 30) << "written before an error";

  // Found at the first pixel, whichever thread is first.
  const std::string elsewhere = " has id 0, of a triangle that does not cover it at its depth";
  const std::pair<Change, std::string> kElsewhere[] = {
      {[&](Call& c) { scene(c).camera.yaw = 2.0f; }, elsewhere},
      {[](Call& c) { c.options.cull = Cull::front; }, elsewhere},
      {[&](Call& c) { scene(c).meshes[0].positions.resize(2); }, elsewhere},
      {[](Call& c) {
         c.drawable = TriangleStream{40, 30, {}};
       },
       " has id 0 of 0 triangles"},
      {[](Call& c) { c.options.first_id = 1; }, " has id 0 of 2 triangles from 1 on"}};
  std::string first;
  shown.for_each_pixel([&](int x, int y, std::size_t) {
    if (first.empty() && shown.has(x, y))
      first = "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
  });
  for (const int threads : {1, 3})
    for (const auto& [change, said] : kElsewhere)
      EXPECT_EQ(message([&](Call& c) { c.execution.threads = threads, change(c); }), first + said);
}

}  // namespace
}  // namespace edgewise

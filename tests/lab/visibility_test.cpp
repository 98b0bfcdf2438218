// The visibility methods: their promises, their failures, and the depth separation at which each format
// fails.
#include "lab/visibility/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "edgewise/contract.h"
#include "lab/stage_methods.h"
#include "lab/truth/oracle.h"

namespace edgewise::lab {
namespace {

constexpr auto& method = find_visibility_method;
VisibilityScene make_case(std::string_view name) {
  return std::ranges::find(visibility_cases(), name, &VisibilityCase::name)->make();
}
VisibilityScore judge(std::string_view name, const VisibilityScene& scene) {
  return score(method(name), scene, true_visible_triangles(scene)).snapped;
}

TEST(Visibility, EveryMethodKeepsItsPromiseAndFailsSomewhere) {
  std::map<std::string_view, std::uint64_t> wrong;
  for (const auto& c : visibility_cases()) {
    const VisibilityScene scene = c.make();
    const auto visible = true_visible_triangles(scene);
    for (const auto& m : visibility_methods()) {
      const auto s = score(m, scene, visible);
      EXPECT_GT(s.snapped.covered, 100u) << c.name;
      EXPECT_EQ(s.broken, 0u) << m.info.name << " on " << c.name;
      wrong[m.info.name] += s.snapped.wrong_triangle;
      if (m.info.name == "contract31") {
        EXPECT_EQ(s.snapped.wrong_triangle, s.depth_ties) << c.name;
      }
    }
  }
  for (const auto& m : visibility_methods()) EXPECT_GT(wrong[m.info.name], 0u) << m.info.name;
}

// Gives one method another method's promise, to check that the score detects a broken promise.
TEST(Visibility, BrokenPromisesOfSortingMethodsAreCounted) {
  const VisibilityScene scene = make_case("front_to_back");
  const auto visible = true_visible_triangles(scene);
  VisibilityMethod unsorted = method("submission_order");
  EXPECT_EQ(score(unsorted, scene, visible).broken, 0u);
  unsorted.may_occlude = method("painter_mean").may_occlude;
  const auto s = score(unsorted, scene, visible);
  EXPECT_GT(s.broken, 0u);
  EXPECT_EQ(s.broken, s.snapped.wrong_triangle) << "all depth ranges are apart";

  const VisibilityScene floor = make_case("floor_under_box");  // the box is submitted last, and occluded
  VisibilityMethod mean = method("painter_mean");
  mean.may_occlude = method("submission_order").may_occlude;
  EXPECT_GT(score(mean, floor, true_visible_triangles(floor)).broken, 0u);
}

// Painter's methods sort polygons by all corners, and paint each polygon as a whole.
TEST(Visibility, PaintersSortPolygonsByAllTheirCorners) {
  const auto wrong_pixels = [](std::string_view name, const VisibilityScene& scene) {
    return judge(name, scene).wrong_triangle;
  };
  const VisibilityScene pentagon = make_case("pentagon_under_wall");
  ASSERT_EQ(pentagon.faces.size(), 2u);
  EXPECT_EQ(pentagon.faces[0].count, 3u);
  // 46 is nearer than 50, so the pentagon is painted last, over the whole wall in front of it.
  EXPECT_GT(wrong_pixels("painter_mean", pentagon), 100u);
  EXPECT_EQ(wrong_pixels("painter_farthest", pentagon), 0u);

  const VisibilityScene bent = make_case("bent_quad");
  for (const auto name : {"painter_mean", "painter_farthest"})
    EXPECT_GT(wrong_pixels(name, bent), 500u) << name << ": one key for two planes";
  EXPECT_EQ(wrong_pixels("contract31", bent), 0u);
}

TEST(Visibility, OursMatchesTheOracle) {
  for (const auto& c : visibility_cases()) {
    const VisibilityScene scene = c.make();
    std::vector<ScreenTriangle> triangles;
    for (const auto& t : scene.triangles) {
      triangles.push_back(t.screen);
      triangles.back().payload = static_cast<std::uint32_t>(triangles.size() - 1);
    }
    Framebuffer oracle(scene.width, scene.height);
    draw_oracle(triangles, oracle, kNoTriangle);
    VisibilityFrame frame;
    method("contract31").draw(scene, frame);
    for (int y = 0; y < scene.height; ++y) {
      const auto row = static_cast<std::ptrdiff_t>(y) * scene.width;
      EXPECT_TRUE(
          std::equal(oracle.depth_row(y), oracle.depth_row(y) + scene.width, frame.depth32.begin() + row));
      EXPECT_TRUE(std::equal(oracle.payload_row(y), oracle.payload_row(y) + scene.width,
                             frame.visible.begin() + row));
    }
  }
}

// The truth's distances come from the positions, also for clipped triangles, and not from rounded depths.
TEST(Visibility, TheTruthOfAMeshHasUnroundedDistances) {
  Scene scene;
  scene.camera.near_z = 0.5f, scene.camera.far_z = 1000.0f;
  scene.instances.resize(2);
  scene.instances[0].mesh = 1;  // so that mesh order differs from instance order
  scene.meshes.push_back({{{-30, -20, -700.1f}, {30, -20, -700.3f}, {0, 20, -700.7f}}, {{0, 1, 2}}, {0}});
  scene.meshes.push_back(
      {{{0, -1, 5}, {-2, -1, -40}, {2, -1, -40}}, {{0, 1, 2}}, {0}});  // partly behind the camera
  const auto seen = visibility_scene(scene, {128, 96});
  ASSERT_EQ(seen.triangles.size(), 3u);
  for (std::size_t piece = 0; piece < 2; ++piece)
    for (const double z : seen.triangles[piece].view_z)
      EXPECT_TRUE(z == 40.0 || std::abs(z - 0.5) < 1e-5) << z;
  const auto& far_away = seen.triangles[2];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(far_away.view_z[k], -double{scene.meshes[0].positions[k].z});
  const double depth01 = (far_away.screen.z[1] - double{contract::kDepthHead}) / contract::kDepthRange;
  const double by_depth = 500.0 / (1000.0 - depth01 * 999.5);
  EXPECT_GT(std::abs(by_depth - far_away.view_z[1]), 1e-5);
}

}  // namespace
}  // namespace edgewise::lab

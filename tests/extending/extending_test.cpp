// The examples of README.md are in the lists and work together.
#include <gtest/gtest.h>

#include "edgewise/builtin.h"
#include "edgewise/frontend.h"
#include "lab/coverage/coverage.h"
#include "support.h"

namespace edgewise {
namespace {

TEST(Extending, EveryBackendDrawsTheExamplesScene) {
  Frontend frontend;
  const Drawable scene = find_scene("staircase").make({});
  const auto triangles = frontend.run(scene, {.width = 320, .height = 180});
  Framebuffer expected(320, 180), actual(320, 180);
  find_backend("quadtree").make()->draw(triangles, expected.view(), {testing::kBackground});
  EXPECT_GT(lab::covered_pixels(triangles, 320, 180), 5'000u);
  for (const BackendInfo& backend : backends()) {
    backend.make()->draw(triangles, actual.view(), {testing::kBackground});
    testing::expect_same(expected, actual, std::string(backend.name));
  }
}

TEST(Extending, AdditionsFollowTheBuiltInEntries) {
  EXPECT_EQ(backends().back().name, "quadtree");
  EXPECT_EQ(builtin_scenes().back().name, "staircase");
  EXPECT_EQ(lab::coverage_methods().back().info.name, "double_snapped");
}

}  // namespace
}  // namespace edgewise

// Depth at the near and far planes: triangles on the planes are drawn, triangles beyond them are not, and
// triangles between them have the depths of their exact plane.
#include <cmath>
#include <glm/glm.hpp>

#include "conformance/pipeline.h"

namespace edgewise::conformance {
namespace {

using contract::kDepthHead;
using contract::kDepthRange;

class ConformanceDepth : public Conformance {
 protected:
  void expect_wall(const Drawable& drawable, std::uint32_t depth, const std::string& what) {
    with_each(what, [&](Pipeline& pipeline) {
      const Framebuffer& frame = pipeline.draw(drawable, {});
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x) ASSERT_EQ(frame.depth_row(y)[x], depth);
    });
  }
};

TEST_F(ConformanceDepth, WallsOnThePlanesHaveTheEndsOfTheDepthRangeAndThoseBeyondDrawNothing) {
  expect_wall(wall(0.0f), kDepthHead, "on the near plane");
  expect_wall(wall(-0.0f), kDepthHead, "on the near plane, minus zero");
  expect_wall(wall(1.0f), kDepthHead + kDepthRange, "on the far plane");
  for (const float z : kBeyondNearAndFar) expect_nothing(wall(z), {}, std::to_string(z));
}

// With near 1 and far 2 the projection is exact: depth is 2 - 2 / w, times w.
TEST_F(ConformanceDepth, CameraWallsHaveTheExpectedDepth) {
  const auto wall_at = [](float distance) {
    Scene scene;
    scene.meshes.push_back({{{-9, -9, -distance}, {-9, 9, -distance}, {9, -9, -distance}, {9, 9, -distance}},
                            {{0, 1, 2}, {3, 2, 1}},
                            {0, 0}});
    scene.instances.push_back({});
    scene.camera.near_z = 1;
    scene.camera.far_z = 2;
    return scene;
  };
  expect_wall(wall_at(1.0f), kDepthHead, "on the near plane");
  expect_wall(wall_at(2.0f), kDepthHead + kDepthRange, "on the far plane");
  for (const float beyond : {std::nextafter(1.0f, 0.0f), 0.5f, 0.0f, -1.5f, std::nextafter(2.0f, 3.0f), 1e5f})
    expect_nothing(wall_at(beyond), {}, std::to_string(beyond));
}

// A slope from nearer than the near plane to beyond the far plane, clipped where floats and the grid are
// exact. The clipped edge runs along a column of samples, which are covered if it is a left edge.
TEST_F(ConformanceDepth, ASlopeThroughBothPlanesIsDrawnBetweenThem) {
  const auto what = [](float start, bool falls, int bits) {
    return "start " + std::to_string(start) + (falls ? " falling, " : ", ") + std::to_string(bits) + " bits";
  };
  for (const int bits : kBits)
    for (const float start : kSlopeStarts)
      for (const bool falls : {false, true})
        with_each(what(start, falls, bits), [&](Pipeline& pipeline) {
          const TriangleStream stream = slope(start, falls);
          const auto hits = pipeline.hits(stream, {.subpixel_bits = bits});
          const Framebuffer& frame = pipeline.draw(stream, {.subpixel_bits = bits});
          for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
              const float sample = static_cast<float>(x) + 0.5f;
              const bool between = sample >= start && sample < start + 32;
              ASSERT_EQ(hits[static_cast<std::size_t>(y * 64 + x)], between) << x << ", " << y;
              ASSERT_EQ(frame.depth_row(y)[x] == contract::kDepthClear, !between);
              if (!between) continue;
              const double z = (sample - start) / 32.0;
              const double exact = kDepthHead + (falls ? 1 - z : z) * kDepthRange;
              ASSERT_LT(std::abs(frame.depth_row(y)[x] - exact), contract::kDepthError) << x << ", " << y;
            }
        });
}

}  // namespace
}  // namespace edgewise::conformance

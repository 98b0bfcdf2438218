// Checks that the engine with other numbers is the backend `tiled` but for its edge functions.
#include <gtest/gtest.h>

#include <algorithm>

#include "lab/cases/backend_comparison.h"
#include "lab/coverage_support.h"
#include "lab/engine/engine.h"

namespace edgewise::lab {
namespace {

using testing::adversarial;
using testing::hard_floats;

constexpr std::uint32_t kBackground = 0xC0FFEE;
constexpr Window kWindow{203, 131};
constexpr EngineArithmetic kArithmetics[] = {EngineArithmetic::exact,   EngineArithmetic::int64,
                                             EngineArithmetic::float64, EngineArithmetic::float32,
                                             EngineArithmetic::int32,   EngineArithmetic::float32_rebased};

Framebuffer engine_picture(EngineArithmetic numbers, std::span<const ScreenTriangle> triangles,
                           const Execution& execution) {
  Framebuffer frame(kWindow.width, kWindow.height);
  make_engine(numbers)->draw(triangles, frame.view(), {kBackground}, execution);
  return frame;
}

// Triangles for which the numbers hold every edge value exactly.
std::vector<ScreenTriangle> exact_for(EngineArithmetic numbers, std::vector<ScreenTriangle> triangles) {
  if (numbers == EngineArithmetic::float32 || numbers == EngineArithmetic::float32_rebased)
    for (ScreenTriangle& t : triangles)
      for (int i = 0; i < 3; ++i)
        for (std::int32_t* v : {&t.x_q15[i], &t.y_q15[i]})
          *v = std::clamp(*v, -256 * contract::kPixel_q15, 256 * contract::kPixel_q15) / (64 * 128) *
               (64 * 128);
  if (numbers == EngineArithmetic::int32)
    std::erase_if(triangles, [&](const ScreenTriangle& t) {
      const auto side = [](const std::int32_t(&v)[3]) {
        return std::max({v[0], v[1], v[2]}) - std::min({v[0], v[1], v[2]});
      };
      return std::max(side(t.x_q15), side(t.y_q15)) > 178 * contract::kPixel_q15;
    });
  return triangles;
}

TEST(Engine, DrawsTiledsPictureWhereItsNumbersHold) {
  const auto tiled = find_backend("tiled").make();
  for (const auto numbers : kArithmetics)
    for (const auto family : testing::kFamilies) {
      const auto triangles = exact_for(numbers, adversarial(family, 300, kWindow.width, kWindow.height, 17));
      Framebuffer expected(kWindow.width, kWindow.height);
      tiled->draw(triangles, expected.view(), {kBackground});
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 3})
          for (const int tile_size : {16, 32, 64})
            ASSERT_EQ(
                compare(engine_picture(numbers, triangles, {threads, tile_size, target}), expected).pixels,
                0u)
                << static_cast<int>(numbers) << " " << family << " " << name_of(target) << " " << threads
                << " threads, tiles of " << tile_size;
    }
}

TEST(Engine, DrawsTheSamePictureOnEveryTargetAndNumberOfThreads) {
  for (const auto numbers : kArithmetics)
    for (const auto family : testing::kFloatFamilies) {
      const auto grid = snapped(hard_floats(family, 300, kWindow, 23));
      const auto draw = [&](const Execution& execution) { return engine_picture(numbers, grid, execution); };
      const Framebuffer expected = draw({1, 64, SimdTarget::scalar});
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 2})
          ASSERT_EQ(compare(draw({threads, 64, target}), expected).pixels, 0u)
              << static_cast<int>(numbers) << " " << family << " " << name_of(target) << " " << threads
              << " threads";
    }
}

}  // namespace
}  // namespace edgewise::lab

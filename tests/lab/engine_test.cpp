// Checks that the engine with other numbers is the backend `tiled` but for its edge functions or depths.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <random>

#include "lab/coverage_support.h"
#include "lab/engine/engine.h"
#include "lab/measure.h"

namespace edgewise::lab {
namespace {

using testing::adversarial;
using testing::as_floats;
using testing::hard_floats;

constexpr std::uint32_t kBackground = 0xC0FFEE;
constexpr Window kWindow{203, 131};

Framebuffer engine_picture(EngineNumbers numbers, const CoverageInput& input, const Execution& execution) {
  Framebuffer frame(kWindow.width, kWindow.height);
  TileScratch scratch;
  draw_engine(numbers, input, kWindow, frame.view(), kBackground, execution, scratch);
  return frame;
}

// Triangles for which the numbers hold every edge value exactly.
std::vector<ScreenTriangle> exact_for(EngineNumbers numbers, std::vector<ScreenTriangle> triangles) {
  const auto on_grid = [&](std::int32_t step_sub, std::int32_t limit_sub) {
    for (ScreenTriangle& t : triangles)
      for (int i = 0; i < 3; ++i)
        for (std::int32_t* v : {&t.x_sub[i], &t.y_sub[i]})
          *v = std::clamp(*v, -limit_sub, limit_sub) / step_sub * step_sub;
  };
  const auto at_most = [&](int side_px) {
    std::erase_if(triangles, [&](const ScreenTriangle& t) {
      const auto side = [](const std::int32_t(&v)[3]) {
        return std::max({v[0], v[1], v[2]}) - std::min({v[0], v[1], v[2]});
      };
      return std::max(side(t.x_sub), side(t.y_sub)) > side_px * contract::kSub;
    });
  };
  switch (numbers) {
    case EngineNumbers::float_top_left:
    case EngineNumbers::float_rebased:
    case EngineNumbers::float_snapped:
      on_grid(64, 256 * contract::kSub);
      break;
    case EngineNumbers::fixed_4_int32:
      on_grid(16, contract::kGuardSub);
      at_most(2893);
      break;
    case EngineNumbers::fixed_8_int32:
      at_most(178);
      break;
    default:
      break;
  }
  return triangles;
}

TEST(Engine, DrawsTiledsPictureWhereItsNumbersHold) {
  const auto tiled = find_backend("tiled").make();
  for (const auto numbers :
       {EngineNumbers::exact, EngineNumbers::fixed_8_int64, EngineNumbers::double_top_left,
        EngineNumbers::fixed_8_int32, EngineNumbers::fixed_4_int32, EngineNumbers::float_top_left,
        EngineNumbers::float_rebased, EngineNumbers::float_snapped})
    for (const auto family : testing::kFamilies) {
      const auto triangles = exact_for(numbers, adversarial(family, 300, kWindow.width, kWindow.height, 17));
      const auto floats = as_floats(triangles);
      Framebuffer expected(kWindow.width, kWindow.height);
      tiled->draw(triangles, expected.view(), kBackground, {});
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 3})
          for (const int tile_size : {16, 32, 64})
            ASSERT_EQ(
                compare(engine_picture(numbers, {floats, triangles}, {threads, tile_size, target}), expected)
                    .pixels,
                0u)
                << static_cast<int>(numbers) << " " << family << " " << name_of(target) << " " << threads
                << " threads, tiles of " << tile_size;
    }
}

TEST(Engine, DrawsTheSamePictureOnEveryTargetAndNumberOfThreads) {
  for (int numbers = 0; numbers < static_cast<int>(EngineNumbers::kCount); ++numbers)
    for (const auto family : testing::kFloatFamilies) {
      const auto floats = hard_floats(family, 300, kWindow, 23);
      const auto grid = snapped(floats);
      const auto draw = [&](const Execution& execution) {
        return engine_picture(static_cast<EngineNumbers>(numbers), {floats, grid}, execution);
      };
      const Framebuffer expected = draw({1, 64, SimdTarget::scalar});
      for (const SimdTarget target : supported_targets())
        for (const int threads : {1, 2})
          ASSERT_EQ(compare(draw({threads, 64, target}), expected).pixels, 0u)
              << numbers << " " << family << " " << name_of(target) << " " << threads << " threads";
    }
}

std::vector<std::uint32_t> depths_of(const Framebuffer& frame) {
  std::vector<std::uint32_t> depths;
  for (int y = 0; y < frame.height(); ++y)
    depths.insert(depths.end(), frame.depth_row(y), frame.depth_row(y) + frame.width());
  return depths;
}

// The smallest of all depths, with bits dropped, is the smallest of the depths with bits dropped.
TEST(Engine, KeepsTheUpperBitsOfTheDepths) {
  for (const auto& [numbers, bits] : {std::pair{EngineNumbers::depth_24, 24}, {EngineNumbers::depth_16, 16}})
    for (const auto family : testing::kFamilies) {
      const auto triangles = adversarial(family, 300, kWindow.width, kWindow.height, 31);
      const auto floats = as_floats(triangles);
      auto expected = depths_of(engine_picture(EngineNumbers::exact, {floats, triangles}, {}));
      for (std::uint32_t& z : expected)
        if (z != contract::kDepthClear) z >>= 31 - bits;
      for (const int tile_size : {16, 64})
        EXPECT_EQ(depths_of(engine_picture(numbers, {floats, triangles}, {1, tile_size})), expected)
            << bits << " bits, " << family << ", tiles of " << tile_size;
    }
}

TEST(Engine, EvaluatesDepthsInFloatsCloseToTheContracts) {
  std::mt19937 random(37);
  const auto in = [&](std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  std::vector<ScreenTriangle> triangles;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto x = static_cast<std::int32_t>(in(0, 150) * contract::kSub),
               y = static_cast<std::int32_t>(in(0, 80) * contract::kSub), side = 50 * contract::kSub;
    ScreenTriangle t{{x, x + side, x}, {y, y, y + side}, {}, i};
    if (i % 2 == 0) std::swap(t.x_sub[1], t.x_sub[2]), std::swap(t.y_sub[1], t.y_sub[2]);
    for (std::uint32_t& z : t.z) z = contract::kDepthHead + in(0, contract::kDepthRange);
    triangles.push_back(t);
  }
  const auto floats = as_floats(triangles);
  const auto expected = depths_of(engine_picture(EngineNumbers::exact, {floats, triangles}, {}));
  for (const SimdTarget target : supported_targets()) {
    const auto drawn =
        depths_of(engine_picture(EngineNumbers::depth_float, {floats, triangles}, {1, 64, target}));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(drawn[i] == contract::kDepthClear, expected[i] == contract::kDepthClear) << i;
      if (expected[i] == contract::kDepthClear) continue;
      ASSERT_NEAR(std::bit_cast<float>(drawn[i]), contract::depth01(expected[i]), 1e-5) << i;
    }
  }
}

// A vertex that snaps across a sample or a tile's border must not lose the triangle's pixels.
TEST(Engine, BinsUnsnappedTrianglesToEveryTileTheyTouch) {
  constexpr float kBit = 1.0f / 1024.0f;  // snaps to the grid
  std::vector<FloatTriangle> floats;
  for (const float x : {63.5f, 64.5f, 127.5f})
    for (const float y : {63.5f, 64.5f}) {
      floats.push_back({{{x - 30, x + kBit, x - 30}, {y, y, y + 20}, {0.5f, 0.5f, 0.5f}}, 1});
      floats.push_back({{{x, x, x + 20}, {y - 30, y + kBit, y - 30}, {0.5f, 0.5f, 0.5f}}, 1});
      floats.push_back({{{x - 90, x + kBit, x - 90}, {y - 90, y + kBit, y + 20}, {0.5f, 0.5f, 0.5f}}, 1});
    }
  const testing::Picture picture(floats, kWindow);
  const CoverageScore score = testing::against_floats("engine_double", picture);
  EXPECT_EQ(score.errors(), 0u);
  EXPECT_GT(testing::against_floats("engine_exact", picture).errors(), 0u);
}

TEST(Engine, KeepsToTheBlocksOfEachTrianglesBox) {
  for (const CoverageMethod& method : engine_methods())
    for (const auto family : testing::kFloatFamilies) {
      const auto floats = hard_floats(family, 100, kWindow, 29);
      const auto grid = snapped(floats);
      std::vector<lab::Run> runs;
      method.runs({floats, grid}, kWindow, runs);
      for (const lab::Run& run : runs) {
        const ScreenTriangle& t = grid[run.triangle];
        const auto blocks = [](const std::int32_t(&v)[3], int margin) {
          const auto [low, high] = std::minmax({v[0], v[1], v[2]});
          return std::pair((low - margin) / contract::kSub / 4 * 4,
                           (high + margin) / contract::kSub / 4 * 4 + 4);
        };
        const auto [x0, x1] = blocks(t.x_sub, 8);  // the largest margin
        const auto [y0, y1] = blocks(t.y_sub, 8);
        ASSERT_TRUE(run.x0 >= x0 && run.x1 <= x1 && run.y >= y0 && run.y < y1)
            << method.info.name << " " << family << " " << run.triangle;
      }
    }
}

TEST(Engine, OverflowsWhereItSaysSo) {
  for (const auto& [name, side_px, wraps] : {std::tuple{"engine_fixed_8_int32", 178, false},
                                             {"engine_fixed_8_int32", 190, true},
                                             {"engine_fixed_4_int32", 2893, false},
                                             {"engine_fixed_4_int32", 3000, true}}) {
    const auto side = static_cast<float>(side_px) - 1;
    const Window window{side_px + 20, side_px + 20};
    const testing::Picture picture({{{{3, 3 + side, 3}, {3, 3, 3 + side}, {0, 0, 0}}, 1},
                                    {{{3 + side, 3 + side, 3}, {3, 3 + side, 3 + side}, {0, 0, 0}}, 1}},
                                   window);
    EXPECT_EQ(testing::against_grid(name, picture).errors() != 0, wraps) << name << " " << side_px;
  }
}

}  // namespace
}  // namespace edgewise::lab

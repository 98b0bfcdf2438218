// Checks that every cell of the experiment draws the picture of `naive`.
#include "lab/cells/cells.h"
#include "edgewise/draw.h"

#include <gtest/gtest.h>

#include <set>

#include "edgewise/builtin.h"
#include "lab/measure.h"
#include "support.h"

namespace edgewise::lab {
namespace {

using testing::expect_same;
using testing::kBackground;

// Vector cells run on every vector target.
std::vector<Execution> executions(const Cell& cell) {
  std::vector<Execution> all;
  for (const int threads : {1, 2, 3})
    for (const SimdTarget target : supported_targets())
      if ((target == SimdTarget::scalar) == (cell.target == SimdTarget::scalar))
        all.push_back({threads, 64, target});
  return all;
}

TEST(Cells, DrawTheSamePicturesOfAllScenes) {
  constexpr int kWidth = 203, kHeight = 131;
  const auto naive = find_backend("naive").make();
  for (const SceneInfo& scene : builtin_scenes()) {
    const Drawable drawable = scene.make({.width = kWidth, .height = kHeight, .scale = 0.02});
    Framebuffer expected(kWidth, kHeight), found(kWidth, kHeight);
    for (const Cell& cell : cells()) {
      const auto backend = cell.backend.make();
      for (const Execution& execution : executions(cell)) {
        const FrontendOptions options{.width = kWidth, .height = kHeight};
        Frontend frontend;
        naive->draw(frontend.run(drawable, options, execution), expected.view(), {kBackground});
        poison(found);
        draw(drawable, frontend, options, *backend, found.view(), {kBackground}, execution);
        expect_same(expected, found,
                    std::string(scene.name) + ", " + factors(cell) + ", " + testing::describe(execution));
      }
    }
  }
}

TEST(Cells, DrawTheSamePicturesOfHardTriangles) {
  const auto naive = find_backend("naive").make();
  for (const auto& [width, height] : {std::pair{97, 71}, {5, 40}, {200, 130}})
    for (const auto family : testing::kFamilies) {
      const auto triangles = testing::adversarial(family, 300, width, height, 7);
      Framebuffer expected(width, height), found(width, height);
      naive->draw(triangles, expected.view(), {kBackground});
      for (const Cell& cell : cells()) {
        const auto backend = cell.backend.make();
        for (const Execution& execution : executions(cell)) {
          poison(found);
          backend->draw(triangles, found.view(), {kBackground}, execution);
          expect_same(expected, found,
                      std::string(family) + ", " + factors(cell) + ", " + testing::describe(execution));
        }
      }
    }
}

TEST(Cells, DrawTheSamePicturesInTheSameRenderPasses) {
  const auto naive = find_backend("naive").make();
  std::size_t draws = 0;
  for (const auto& [width, height] : {std::pair{97, 71}, {5, 40}, {200, 130}})
    for (const auto family : testing::kFamilies) {
      const auto triangles = testing::adversarial(family, 300, width, height, 8);
      const std::span first = std::span(triangles).first(100), rest = std::span(triangles).subspan(100);
      for (const PixelRect& scissor :
           {PixelRect{}, {1, 2, 3, 35}, {37, 21, 50, 80}, {64, 32, 32, 33}, {-9, 63, 110, 1}}) {
        const bool depth_only = draws++ % 3 == 0;
        const auto draw_both = [&](Backend& backend, Framebuffer& frame, const Execution& execution) {
          poison(frame);
          FrameView view = frame.view();
          if (depth_only) view.payload = nullptr;
          backend.draw(first, view, {kBackground}, execution);
          backend.draw(rest, view, {.clear = false, .scissor = scissor}, execution);
          backend.draw(first, view, {.background = 1, .scissor = {50, 9, scissor.width, 7}}, execution);
        };
        Framebuffer expected(width, height), found(width, height);
        draw_both(*naive, expected, {});
        for (const Cell& cell : cells()) {
          const auto backend = cell.backend.make();
          for (const Execution& execution : executions(cell)) {
            draw_both(*backend, found, execution);
            expect_same(expected, found,
                        std::string(family) + ", " + factors(cell) + ", " + testing::describe(execution));
          }
        }
      }
    }
}

// {bands, tiles} x {spans, edges} x {scalar, SIMD}, and of the SIMD tiles two more each.
TEST(Cells, AreTwelve) {
  std::set<std::string> names;
  for (const Cell& cell : cells()) names.insert(factors(cell));
  EXPECT_EQ(names.size(), 12u);
  EXPECT_EQ(cells().size(), 12u);
}

}  // namespace
}  // namespace edgewise::lab

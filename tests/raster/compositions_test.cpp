// Every composition of the backends' parts draws the picture of `naive`.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "lab/cases/frame_comparison.h"
#include "lab/cases/hard_triangles.h"
#include "message_of.h"
#include "raster/fill_counts.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::expect_same;
using testing::kBackground;

template <typename Check>
void for_each_composition(Check&& check) {
  constexpr int kTileSizes[] = {64, 16, 32};
  for (const BackendInfo& composition : compositions()) {
    const auto backend = composition.make();
    for (const int threads : {1, 2, 3})
      for (const SimdTarget target : supported_targets()) {
        const Execution execution{threads, kTileSizes[threads - 1], target};
        check(*backend, execution, std::string(composition.name) + ", " + testing::describe(execution));
      }
  }
}

TEST(Compositions, DrawTheSamePicturesOfAllScenes) {
  constexpr int kWidth = 203, kHeight = 131;
  const auto naive = find_backend("naive").make();
  for (const SceneInfo& scene : builtin_scenes()) {
    const Drawable drawable = scene.make({.width = kWidth, .height = kHeight, .scale = 0.02});
    Framebuffer expected(kWidth, kHeight), found(kWidth, kHeight);
    const FrontendOptions options{.width = kWidth, .height = kHeight};
    Frontend frontend;
    naive->draw(frontend.run(drawable, options), expected.view(), {kBackground});
    for_each_composition([&](Backend& backend, const Execution& execution, const std::string& what) {
      lab::poison(found);
      draw(drawable, frontend, options, backend, found.view(), {kBackground}, execution);
      expect_same(expected, found, std::string(scene.name) + ", " + what);
    });
  }
}

TEST(Compositions, DrawTheSamePicturesOfHardTriangles) {
  const auto naive = find_backend("naive").make();
  for (const auto& [width, height] : {std::pair{97, 71}, {5, 40}, {200, 130}})
    for (const auto family : testing::kFamilies) {
      const auto triangles = testing::adversarial(family, 300, width, height, 7);
      Framebuffer expected(width, height), found(width, height);
      naive->draw(triangles, expected.view(), {kBackground});
      for_each_composition([&](Backend& backend, const Execution& execution, const std::string& what) {
        lab::poison(found);
        backend.draw(triangles, found.view(), {kBackground}, execution);
        expect_same(expected, found, std::string(family) + ", " + what);
      });
    }
}

TEST(Compositions, DrawTheSamePicturesInTheSameRenderPasses) {
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
          lab::poison(frame);
          FrameView view = frame.view();
          if (depth_only) view.payload = nullptr;
          backend.draw(first, view, {kBackground}, execution);
          backend.draw(rest, view, {.clear = false, .scissor = scissor}, execution);
          backend.draw(first, view, {.background = 1, .scissor = {50, 9, scissor.width, 7}}, execution);
        };
        Framebuffer expected(width, height), found(width, height);
        draw_both(*naive, expected, {});
        for_each_composition([&](Backend& backend, const Execution& execution, const std::string& what) {
          draw_both(backend, found, execution);
          expect_same(expected, found, std::string(family) + ", " + what);
        });
      }
    }
}

#ifdef EDGEWISE_COUNT_FILLS
// The parts that drew or rejected triangles, by their names.
std::string parts_used(const BackendInfo& info) {
  constexpr int kSide = 2 * contract::kMaxTile, kEnd = 2 * kSide * contract::kSub;
  std::vector<ScreenTriangle> triangles{{{0, kEnd, 0}, {0, 0, kEnd}, {5, 5, 5}, 1},
                                        {{0, kEnd, 0}, {0, 0, kEnd}, {9, 9, 9}, 2}};
  for (int i = 0; i < 16; ++i) {  // small ones, in every tile
    const int x = (i % 4 * 32 + 9) * contract::kSub, y = (i / 4 * 32 + 9) * contract::kSub,
              leg = 5 * contract::kSub;
    triangles.push_back({{x, x + leg, x}, {y, y, y + leg}, {1, 1, 1}, 3});
  }
  Framebuffer frame(kSide, kSide);
  for (auto& n : fill_counts) n = 0;
  info.make()->draw(triangles, frame.view(), {}, {.threads = 2});
  constexpr std::string_view kNames[] = {"boxes",      "spans", "edges", "tile_spans",
                                         "tile_edges", "masks", "hiz"};
  std::string used;
  for (std::size_t i = 0; i < fill_counts.size(); ++i)
    if (fill_counts[i] != 0) used += (used.empty() ? "" : " ") + std::string(kNames[i]);
  return used;
}

TEST(Compositions, DrawByTheirPartsOnly) {
  if (resolve(SimdTarget::best) == SimdTarget::scalar) GTEST_SKIP() << "HiZ and masks need vectors";
  const std::map<std::string_view, std::string_view> expected{
      {"naive", "boxes"},
      {"scanline", "spans"},
      {"tiled", "tile_edges masks hiz"},
      {"bands+spans", "spans"},
      {"bands+edges", "edges"},
      {"tiles+spans", "tile_spans"},
      {"tiles+spans+hiz", "tile_spans hiz"},
      {"tiles+spans+masks", "tile_spans masks"},
      {"tiles+spans+hiz+masks", "tile_spans masks hiz"},
      {"tiles+edges", "tile_edges"},
      {"tiles+edges+hiz", "tile_edges hiz"},
      {"tiles+edges+masks", "tile_edges masks"},
      {"tiles+edges+hiz+masks", "tile_edges masks hiz"}};
  for (const auto list : {backends(), compositions()})
    for (const BackendInfo& info : list) EXPECT_EQ(parts_used(info), expected.at(info.name)) << info.name;
}
#endif

TEST(Compositions, AreFoundByTheirNames) {
  EXPECT_EQ(compositions().size(), 10u);
  for (const BackendInfo& composition : compositions())
    EXPECT_EQ(&find_backend(composition.name), &composition);
  EXPECT_EQ(message_of([] { find_backend("tiles+edge"); }).substr(0, 62),
            "unknown backend 'tiles+edge'; did you mean 'tiles+edges'? (kno");
}

}  // namespace
}  // namespace edgewise

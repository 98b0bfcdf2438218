// Every composition of the backends' parts draws the picture of `naive`.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/hard_triangles.h"
#include "message_of.h"
#include "raster/kernels.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::expect_same;
using testing::kBackground;

// Each composition on each target and 1, 2 and 3 threads, or on one of these in turn.
template <typename Check>
void for_each_composition(bool all_threads, Check&& check) {
  constexpr int kTileSizes[] = {64, 16, 32};
  static int turn = 0;
  for (const BackendInfo& composition : compositions()) {
    const auto backend = composition.make();
    for (const SimdTarget target : supported_targets()) {
      if (testing::kRacesOnly && target != supported_targets().back()) continue;
      ++turn;
      for (int threads = 1; threads <= 3; ++threads) {
        const bool is_drawn = testing::kRacesOnly ? threads == 3 : all_threads || turn % 3 + 1 == threads;
        if (!is_drawn) continue;
        const Execution execution{threads, kTileSizes[(turn + threads) % 3], target};
        check(*backend, execution, std::string(composition.name) + ", " + testing::describe(execution));
      }
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
    for_each_composition(false, [&](Backend& backend, const Execution& execution, const std::string& what) {
      lab::poison(found);
      draw(drawable, frontend, options, backend, found.view(), {kBackground}, execution);
      expect_same(expected, found, std::string(scene.name) + ", " + what);
    });
  }
}

TEST(Compositions, DrawTheSamePicturesOfHardTrianglesInRenderPasses) {
  const auto naive = find_backend("naive").make();
  const PixelRect scissors[] = {{}, {1, 2, 3, 35}, {37, 21, 50, 80}, {64, 32, 32, 33}, {-9, 63, 110, 1}};
  Random random(9);
  for (const auto& [width, height] : {std::pair{97, 71}, {5, 40}, {200, 130}}) {
    std::vector<ScreenTriangle> triangles;
    for (const auto family : testing::kFamilies) {
      const auto some = testing::adversarial(family, 100, width, height, 8);
      triangles.insert(triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2), some.begin(),
                       some.end());
    }
    const std::span first = std::span(triangles).first(triangles.size() / 3),
                    rest = std::span(triangles).subspan(first.size());
    for (const bool depth_only : {false, true}) {
      const PixelRect& scissor = scissors[random.below(std::size(scissors))];
      const auto draw_all = [&](Backend& backend, Framebuffer& frame, const Execution& execution) {
        lab::poison(frame);
        FrameView view = frame.view();
        if (depth_only) view.payload = nullptr;
        backend.draw(first, view, {kBackground}, execution);
        backend.draw(rest, view, {.clear = false, .scissor = scissor}, execution);
        backend.draw(first, view, {.background = 1, .scissor = {50, 9, scissor.width, 7}}, execution);
      };
      Framebuffer expected(width, height), found(width, height);
      draw_all(*naive, expected, {});
      for_each_composition(true, [&](Backend& backend, const Execution& execution, const std::string& what) {
        draw_all(backend, found, execution);
        expect_same(expected, found, what);
      });
    }
  }
}

#ifdef EDGEWISE_COUNT_FILLS
// Which parts drew or rejected how many triangles, counted once per band, tile or strip of a light tile. The
// scene: two large ones, the second behind the first, 16 small ones, and one alone in its tile. Spans count
// the large ones also in the tile of their boxes where they cover nothing.
std::string parts_used(const BackendInfo& info, SimdTarget target) {
  const auto right_angled = [](int x_px, int y_px, int leg_px, std::uint32_t z) {
    using contract::kPixel_q15;
    const std::int32_t x = x_px * kPixel_q15, y = y_px * kPixel_q15, leg = leg_px * kPixel_q15;
    return ScreenTriangle{{x, x + leg, x}, {y, y, y + leg}, {z, z, z}, 1};
  };
  std::vector triangles{right_angled(0, 0, 128, 500), right_angled(0, 0, 128, 900),
                        right_angled(130, 10, 40, 500)};
  for (int i = 0; i < 16; ++i) triangles.push_back(right_angled(i % 4 * 32 + 9, i / 4 * 32 + 9, 5, 200));
  Framebuffer frame(192, 128);
  for (auto& n : fill_counts) n = 0;
  info.make()->draw(triangles, frame.view(), {}, {.threads = 2, .target = target});
  constexpr std::string_view kNames[] = {"boxes",      "spans", "edges", "tile_spans",
                                         "tile_edges", "masks", "hiz"};
  std::string used;
  for (std::size_t i = 0; i < fill_counts.size(); ++i)
    if (fill_counts[i] != 0) used += std::string(kNames[i]) + ' ' + std::to_string(fill_counts[i]) + ' ';
  return used;
}

TEST(Compositions, DrawByTheirPartsOnly) {
  const std::map<std::string_view, std::string_view> expected{
      {"naive", "boxes 26 "},
      {"scanline", "spans 26 "},
      {"tiled", "spans 4 tile_edges 5 masks 16 hiz 1 "},
      {"bands+spans", "spans 26 "},
      {"bands+edges", "edges 26 "},
      {"tiles+spans", "tile_spans 25 "},
      {"tiles+spans+hiz", "tile_spans 24 hiz 1 "},
      {"tiles+spans+masks", "tile_spans 9 masks 16 "},
      {"tiles+spans+hiz+masks", "tile_spans 8 masks 16 hiz 1 "},
      {"tiles+edges", "tile_edges 23 "},
      {"tiles+edges+hiz", "tile_edges 22 hiz 1 "},
      {"tiles+edges+masks", "tile_edges 7 masks 16 "},
      {"tiles+edges+hiz+masks", "tile_edges 6 masks 16 hiz 1 "}};
  for (const SimdTarget target : supported_targets()) {
    if (target == SimdTarget::scalar) continue;  // it has no masks, and spans have no HiZ
    for (const auto list : {backends(), compositions()})
      for (const BackendInfo& info : list)
        EXPECT_EQ(parts_used(info, target), expected.at(info.name)) << info.name << ", " << name_of(target);
  }
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

// Compares every backend in the registry, in every configuration, with the brute-force oracle.
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "core/parallel.h"
#include "core/triangle_source.h"
#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "every_backend.h"
#include "lab/cases/backend_comparison.h"
#include "message_of.h"
#include "raster/binning/bins.h"

namespace edgewise {
namespace {

using namespace contract;
using testing::adversarial;
using testing::EveryBackend;
using testing::kBackground;

TEST_P(EveryBackend, MatchesTheOracleForEveryFamily) {
  for (const auto family : testing::kFamilies)
    for (const int count : {0, 1, 7, 200})
      expect_oracle(adversarial(family, count, 97, 71, static_cast<std::uint64_t>(count)), 97, 71,
                    std::string(family));
}

TEST_P(EveryBackend, MatchesTheOracleForEveryNumberOfSubpixelBits) {
  std::uint64_t seed = 0;
  for (int bits = kMinSubpixelBits; bits <= kMaxSubpixelBits; ++bits)
    for (const auto family : testing::kFamilies)
      expect_oracle(adversarial(family, 60, 97, 71, ++seed, bits), 97, 71,
                    std::string(family) + ", " + std::to_string(bits) + " bits");
}

TEST_P(EveryBackend, MatchesTheOracleAtEverySize) {
  constexpr int kSizes[][2] = {{1, 1},   {1, 64},  {64, 1},  {3, 5},    {16, 16},
                               {17, 15}, {63, 65}, {64, 64}, {129, 33}, {200, 130}};
  for (const auto& [width, height] : kSizes)
    for (const auto family : {"uniform", "huge", "cloud"})
      for (const int bits : {8, 15})
        expect_oracle(adversarial(family, 40, width, height, 15, bits), width, height,
                      std::to_string(width) + "x" + std::to_string(height));
}

TEST_P(EveryBackend, MatchesTheOracleForManySlices) {
  // More than one slice and segment, in a small image because the oracle is slow.
  auto triangles = adversarial("cloud", 12'000, 40, 40, 3);
  const auto big = adversarial("uniform", 20, 40, 40, 4);
  triangles.insert(triangles.begin() + 6'000, big.begin(), big.end());
  expect_oracle(triangles, 40, 40, "many slices");
  // If all depths are equal, the order of the slices decides.
  auto at_one_depth = adversarial("uniform", 3'000, 40, 40, 5);
  for (ScreenTriangle& t : at_one_depth) std::fill_n(t.z, 3, kDepthHead + 1000);
  expect_oracle(at_one_depth, 40, 40, "many slices at one depth");
}

// Small and large triangles take different code paths.
TEST_P(EveryBackend, KeepsNothingOfThePreviousFrame) {
  const int width = 150, height = 90;
  const auto small = adversarial("cloud", 40, width, height, 15),
             large = adversarial("uniform", 160, width, height, 2);
  ASSERT_GT(lab::covered_pixels(small, width, height), 40u);
  std::vector<ScreenTriangle> frames[] = {small, large, large, small};
  frames[0].insert(frames[0].end(), large.begin(), large.end());
  frames[1].insert(frames[1].end(), small.begin(), small.end());
  std::vector<Framebuffer> expected;
  for (const auto& triangles : frames) expected.push_back(oracle(triangles, width, height));
  for (const auto& how : testing::executions())
    for (const std::size_t i : {0u, 1u, 2u, 3u, 1u, 0u, 3u, 2u, 0u}) {
      Framebuffer actual(width, height);
      backends_.get(info_, how.tiles).draw(frames[i], actual.view(), {kBackground}, how.execution);
      testing::expect_same(expected[i], actual, std::to_string(i) + ", " + testing::describe(how));
    }
}

TEST_P(EveryBackend, MatchesTheOracleWhenMasksExceedTheirMemory) {
  // At most 8 px wide and high, so that binning makes coverage masks, but most triangles span more than two
  // mask quadrants of 8 x 8.
  constexpr std::int32_t kSide = 2000;
  std::vector<ScreenTriangle> triangles(12'000);
  Random random(1);
  const auto below = [&](int end) { return testing::between(random, 0, end - 1); };
  for (std::uint32_t id = 0; ScreenTriangle & t : triangles) {
    const std::int32_t x = below(90 * Coarse::kSub), y = below(70 * Coarse::kSub);
    t = testing::coarse({{x, x + kSide, x + below(kSide)}, {y, y + below(kSide), y + kSide}, {}, id++});
    for (auto& z : t.z) z = kDepthHead + static_cast<std::uint32_t>(below(1000));
  }
  expect_oracle(triangles, 97, 71, "coverage masks of 8 x 8 pixels");
}

TEST_P(EveryBackend, ReachesTheFarCornerOfTheLargestImage) {
  for (const auto& [width, height] : {std::pair{kMaxImageSide, 3}, {3, kMaxImageSide}})
    for (const int bits : {8, 15})
      expect_oracle(adversarial("uniform", 6, width, height, 2, bits), width, height, "largest side");
}

// Small and large triangles may be in different lists, whose segments fill up at different triangles.
TEST_P(EveryBackend, TiesKeepTheEarlierOfASmallAndALargeTriangle) {
  const auto right_angled = [](int at_px, int side_px, std::uint32_t z, std::uint32_t payload) {
    const std::int32_t begin = at_px * kPixel_q15, end = (at_px + side_px) * kPixel_q15;
    return ScreenTriangle{{begin, end, begin}, {begin, begin, end}, {z, z, z}, payload};
  };
  for (std::uint32_t before = 1; before <= 70; ++before) {
    std::vector<ScreenTriangle> triangles;
    std::uint32_t z = kDepthHead + 1000;
    const auto add_large = [&](int at_px) { triangles.push_back(right_angled(at_px, 80, z, 1)); };
    const auto add_small = [&](int at_px) { triangles.push_back(right_angled(at_px, 3, z, 2)); };
    for (std::uint32_t i = 0; i < before; ++i, z -= 10) add_large(0);
    z += 10;
    add_small(2);  // submitted after the last large one
    z -= 10;
    add_small(6);  // submitted before the next large one
    add_large(6);
    expect_oracle(triangles, 20, 20, "after " + std::to_string(before) + " large ones");
  }
}

// Enough triangles for threads to split slices of them.
TEST_P(EveryBackend, DrawsManyTrianglesTheSameOnEveryThreadCount) {
  const int side = 64;
  std::vector<ScreenTriangle> triangles(1'000'000);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto n = static_cast<std::uint32_t>(i);
    const std::int32_t px = i < triangles.size() / 2 ? 1 : 8;
    const auto x = static_cast<std::int32_t>(n * 2654435761u >> 18),
               y = static_cast<std::int32_t>(n * 40503u >> 18);
    const std::uint32_t z = kDepthHead + (n * 2246822519u >> 12);
    triangles[i] =
        testing::coarse({{x, x + px * Coarse::kSub, x}, {y, y, y + px * Coarse::kSub}, {z, z, z}, n});
  }
  const auto drawn = [&](int threads) {
    Framebuffer frame(side, side);
    Execution execution;
    execution.threads = threads;
    backend_->draw(triangles, frame.view(), {kBackground}, execution);
    return frame;
  };
  const Framebuffer alone = drawn(1);
  for (const int threads : {2, 3})
    testing::expect_same(alone, drawn(threads), std::to_string(threads) + " threads");
}

TEST_P(EveryBackend, RefusesInvalidArguments) {
  Framebuffer frame(8, 8);
  const FrameView good = frame.view();
  std::vector<FrameView> bad(4, good);
  bad[0].width = 0, bad[1].height = kMaxImageSide + 1, bad[2].stride = 7, bad[3].depth = nullptr;
  for (const FrameView& view : bad) EXPECT_THROW(backend_->draw({}, view), std::invalid_argument);
  for (const Execution& execution :
       {Execution{.threads = 0}, {.threads = kMaxThreads + 1}, {.tile_size = 48}})
    EXPECT_THROW(backend_->draw({}, good, {}, execution), std::invalid_argument);
  EXPECT_NO_THROW(backend_->draw({}, good));
  Frontend frontend;
  for (const auto& [width, height] : {std::pair{9, 8}, {8, 7}})
    EXPECT_EQ(message_of([&] {
                backend_->draw(frontend.run(TriangleStream{}, {.width = width, .height = height}), good);
              }),
              "triangles made for " + std::to_string(width) + " x " + std::to_string(height) +
                  " px cannot be drawn into a frame of 8 x 8 px");
}

// A stream's small and large triangles, some beyond the image. Those for which clip(i) is true cross both
// depth planes, so each becomes several triangles, too large for coverage masks. Each kind has many visible
// triangles.
template <typename Clip>
TriangleStream stream_to_clip(std::size_t count, Clip&& clip) {
  constexpr int kWidth = 150, kHeight = 90;
  TriangleStream stream = random_stream({.width = kWidth, .height = kHeight}, count, 20, 0, 3);
  for (std::size_t i = 0; i < count; ++i) {
    auto& vertex = stream.triangles[i].vertex;
    if (i % 7 == 0) vertex[i % 3].x += 60.0f;
    if (!clip(i)) continue;
    const auto below = [&](std::size_t factor, std::size_t n) { return static_cast<float>(i * factor % n); };
    const float x = below(37, 141), y = below(53, 83), z = below(7919, 1000) / 1000;
    vertex[0] = {x, y, -z - 0.1f}, vertex[1] = {x + 18, y + 3, z}, vertex[2] = {x + 6, y + 18, 1.5f};
  }
  return stream;
}

TEST_P(EveryBackend, DrawsADrawableAsTheFrontEndsTriangles) {
  const Drawable drawables[] = {stream_to_clip(5'000, [](std::size_t i) { return i % 500 == 1; }),
                                stream_to_clip(20'000, [](std::size_t) { return true; }),  // fit only later
                                stream_to_clip(3, [](std::size_t) { return false; }), TriangleStream{},
                                find_scene("cubes").make({})};
  struct Way {
    RenderPass pass;
    bool depth_only = false;
  };
  const PixelRect part{33, 15, 70, 64}, outside{-9, -9, 5, 5};
  const Way ways[] = {{{kBackground}},
                      {{.clear = false}},
                      {{.background = kBackground, .scissor = part}},
                      {{.clear = false, .scissor = part}},
                      {{.scissor = outside}},
                      {{kBackground}, true}};
  std::size_t first = 0;  // each drawable begins with another way
  Frontend plain, frontend;
  const auto before = adversarial("uniform", 20, 150, 90, 3);
  for (const Drawable& drawable : drawables)
    for (std::size_t draws = first++; const auto& how : testing::executions()) {
      const Way& way = ways[draws++ % std::size(ways)];
      const FrontendOptions options{.width = 150,
                                    .height = 90,
                                    .cull = how.execution.threads == 2 ? Cull::back : Cull::none,
                                    .subpixel_bits = draws % 2 == 0 ? 8 : 15};
      Framebuffer expected(150, 90), actual(150, 90);
      const auto view = [&](Framebuffer& frame) {
        lab::poison(frame);
        FrameView prepared = frame.view();
        if (way.depth_only) prepared.payload = nullptr;
        if (!way.pass.clear) backend_->draw(before, prepared, {kBackground}, how.execution);
        return prepared;
      };
      backend_->draw(plain.run(drawable, options, {.threads = 2}), view(expected), way.pass, how.execution);
      draw(drawable, frontend, options, *backend_, view(actual), way.pass, how.execution);
      const std::string what = std::to_string(&drawable - drawables) + ", " + testing::describe(how);
      testing::expect_same(expected, actual, what);
      EXPECT_TRUE(frontend.stats() == plain.stats()) << what;
    }
}

TEST(Draw, MakesAScenesTrianglesOnTheThreadsOfTheExecution) {
  static const detail::ParallelFor library = detail::parallel_for;
  static std::vector<int> used;
  detail::parallel_for = [](int threads, int count, void (*call)(void*, int), void* context) {
    used.push_back(threads);
    library(threads, count, call, context);
  };
  Frontend frontend;
  Framebuffer frame(150, 90);
  draw(find_scene("torus-knot").make({}), frontend, {.width = 150, .height = 90}, *wireframe().make(),
       frame.view(), {}, {.threads = 3});
  detail::parallel_for = library;
  EXPECT_GE(used.size(), 2u) << "front end and backend";
  EXPECT_EQ(std::ranges::count(used, 3), std::ssize(used));
}

TEST(SceneSource, NoticesAMissingVertexBeforeTheFrameIsWritten) {
  Drawable drawable = find_scene("sphere").make({});
  Mesh& mesh = std::get<Scene>(drawable).meshes[0];
  mesh.triangles.back().y = static_cast<std::uint32_t>(mesh.positions.size());
  const FrontendOptions options{.width = 64, .height = 64, .cull = Cull::none};
  for (const BackendInfo& info : backends())
    for (const int threads : {1, 2, 3}) {
      Frontend frontend;
      Framebuffer frame(64, 64), before(64, 64);
      lab::poison(frame), lab::poison(before);
      EXPECT_EQ(message_of([&] {
                  draw(drawable, frontend, options, *info.make(), frame.view(), {}, {.threads = threads});
                }).substr(0, 9),
                "triangle ");
      testing::expect_same(before, frame, std::string(info.name));
    }
}

// All triangles cross the near plane and the guard band. Each becomes five.
TEST(SceneSource, IsMadeTwiceInTheFirstFrameAtMost) {
  struct Probe : Backend {
    bool draw_source(TriangleSource& source, const FramePart& part, const Execution& execution) override {
      const CellGrid grid{part.frame.width, part.frame.height, 6, 6};
      return bins.build(source, grid, execution.threads, execution.target, true);
    }
    void draw_checked(std::span<const ScreenTriangle>, const FramePart&, const Execution&) override {
      ++made_twice;
    }
    Bins bins;
    int made_twice = 0;
  };
  constexpr std::size_t kCount = 100'000;
  Scene scene;
  scene.instances.resize(1);
  scene.meshes.push_back({{{48, 67, 2}, {-39, -82, -1}, {28, 5, -5}},
                          std::vector<glm::uvec3>(kCount, {0, 1, 2}),
                          std::vector<std::uint32_t>(kCount)});
  const FrontendOptions options{.width = 100, .height = 100, .cull = Cull::none};
  for (const int threads : {1, 2, 3}) {
    Probe probe;
    Frontend frontend;
    Framebuffer frame(100, 100);
    for (int i = 0; i < 3; ++i) {
      draw(scene, frontend, options, probe, frame.view(), {}, {.threads = threads});
      EXPECT_EQ(probe.made_twice, 1) << threads << " threads, frame " << i;
    }
    const FrontendStats& stats = frontend.stats();
    EXPECT_EQ(stats.clipped_near + stats.clipped_guard, 2 * kCount);
    EXPECT_EQ(stats.emitted, 5 * kCount);
  }
}

TEST(StreamSource, MayBeUsedAgainAfterAnException) {
  class Throws : public Backend {
    void draw_checked(std::span<const ScreenTriangle>, const FramePart&, const Execution&) override {}
    bool draw_source(TriangleSource& source, const FramePart&, const Execution&) override {
      source.make(0, 0, source.size());
      throw std::length_error("too much");
    }
  };
  const Drawable stream = stream_to_clip(9, [](std::size_t i) { return i == 1; });
  const FrontendOptions options{.width = 150, .height = 90};
  Frontend plain, frontend;
  Framebuffer frame(150, 90);
  plain.run(stream, options);
  Throws throws;
  EXPECT_EQ(message_of([&] { draw(stream, frontend, options, throws, frame.view()); }), "too much");
  EXPECT_TRUE(frontend.stats() == plain.stats()) << "counts of what was made";
  draw(stream, frontend, options, *find_backend("tiled").make(), frame.view());
  EXPECT_TRUE(frontend.stats() == plain.stats());
}

TEST_P(EveryBackend, RefusesADrawableForAnotherSizeOrWithInvalidOptions) {
  const Drawable stream = stream_to_clip(3, [](std::size_t) { return false; });
  Frontend frontend;
  Framebuffer frame(150, 90);
  const auto draw_with = [&](const FrontendOptions& options, const Execution& execution) {
    draw(stream, frontend, options, *backend_, frame.view(), {kBackground}, execution);
  };
  EXPECT_EQ(message_of([&] { draw_with({.width = 151, .height = 90}, {}); }),
            "a drawable with options for 151 x 90 px cannot be drawn into a frame of 150 x 90 px");
  EXPECT_THROW(draw_with({.width = 150, .height = 90}, {.threads = 0}), std::invalid_argument);
  EXPECT_THROW(draw_with({.width = 150, .height = 90}, {.tile_size = 17}), std::invalid_argument);
  draw_with({.width = 150, .height = 90, .keep_states = true}, {});
  EXPECT_EQ(frontend.states().size(), 3u);
  draw_with({.width = 150, .height = 90}, {});
  EXPECT_TRUE(frontend.states().empty());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBackend, ::testing::ValuesIn(testing::all_drawers()),
                         [](const auto& param) { return testing::test_name(param); });

}  // namespace
}  // namespace edgewise

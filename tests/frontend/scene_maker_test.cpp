// Threads make ranges of a scene's triangles, each with vertices of its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "edgewise/frontend.h"
#include "edgewise/limits.h"
#include "frontend/scene_maker.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

// Triangle i names vertices 3 · places[i] … 3 · places[i] + 2, and lies where it would without `places`.
Scene scene_of(const std::vector<std::uint32_t>& places) {
  Mesh mesh;
  mesh.positions.assign(3 * (std::size_t{*std::ranges::max_element(places)} + 1), {0, 0, 1e9f});
  Random random(3);
  for (const std::uint32_t place : places) {
    const glm::vec3 at(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-20, 1));
    for (std::uint32_t k = 0; k < 3; ++k)
      mesh.positions[3 * place + k] =
          at + glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    mesh.triangles.push_back(3 * place + glm::uvec3{0, 1, 2});
    mesh.colours.push_back(place);
  }
  return testing::scene_of(std::move(mesh));
}

// Wherever its vertices lie in memory, a triangle is the same: in order, shuffled within what a worker's
// window holds or over more, in steps that share a granule's slot, and in two distant sequences by turns.
TEST(FrontendWindows, HoldTheVerticesThatTrianglesName) {
  constexpr std::uint32_t kFew = 20'000, kMany = 60'000;
  Random random(1);
  const auto places = [&](std::uint32_t count, auto&& place) {
    std::vector<std::uint32_t> all(count);
    for (std::uint32_t i = 0; i < count; ++i) all[i] = place(i);
    return all;
  };
  const auto shuffled = [&](std::uint32_t count) {
    std::vector<std::uint32_t> all = places(count, [](std::uint32_t i) { return i; });
    for (std::uint32_t i = count; i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
    return all;
  };
  const std::pair<const char*, std::vector<std::uint32_t>> cases[] = {
      {"shuffled, few", shuffled(kFew)},
      {"shuffled, many", shuffled(kMany)},
      {"steps", places(kMany, [](std::uint32_t i) { return i % 10 * (1 << 16) + i / 10; })},
      {"near the window's size", places(40'000, [](std::uint32_t i) { return i % 2 * 20'800 + i / 2; })},
      {"two sequences", places(kMany, [](std::uint32_t i) { return i % 2 * 100'000 + i / 2; })}};
  for (const auto& [name, of_case] : cases) {
    const auto count = static_cast<std::uint32_t>(of_case.size());
    Scene in_order = scene_of(places(count, [](std::uint32_t i) { return i; })), given = scene_of(of_case);
    for (Scene* scene : {&in_order, &given})
      scene->instances.push_back({.scale = {-1, 1, 1}, .angle = 1, .translation = {0, 0, -9}});
    for (const SimdTarget target : supported_targets())
      for (const int threads : {1, 2, 5}) {
        const FrontendOptions options{.width = 640, .height = 480, .payload = Payload::id};
        const Execution execution{.threads = threads, .target = target};
        const auto expected = testing::run(in_order, options, execution),
                   found = testing::run(given, options, execution);
        EXPECT_GT(found.stats.emitted, count / 8);
        EXPECT_GT(found.stats.clipped, 0u);
        testing::expect_same_triangles(expected.triangles, found.triangles, name);
      }
  }
}

// Each triangle becomes five, so that the output grows within a frame. The second frame has room.
TEST(FrontendOrder, HoldsWhenTheOutputGrows) {
  constexpr std::size_t kCount = 70'001, kPieces = 5;
  const Scene scene = testing::scene_of({{{-368, 1374, -5}, {-1006, -1006, -5}, {1374, -368, -5}},
                                         std::vector<glm::uvec3>(kCount, {0, 1, 2}),
                                         std::vector<std::uint32_t>(kCount)});
  for (const int threads : {1, 2, 5})
    for (const bool keep : {false, true}) {
      Frontend frontend;
      const FrontendOptions options{
          .width = 100, .height = 100, .cull = Cull::none, .payload = Payload::id, .keep_unsnapped = keep};
      for (int frame = 0; frame < 2; ++frame) {
        const auto found = frontend.run(scene, options, {.threads = threads});
        ASSERT_EQ(found.size(), kPieces * kCount);
        for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i].payload, i / kPieces);
        ASSERT_EQ(frontend.unsnapped().size(), keep ? found.size() : 0);
        for (std::size_t i = kPieces; i < frontend.unsnapped().size(); ++i)
          ASSERT_EQ(frontend.unsnapped()[i].x_px[1], frontend.unsnapped()[i % kPieces].x_px[1]);
      }
    }
}

// Both Frontend::run() and draw() finish what makes the triangles. Only the counts are too large here.
TEST(TriangleMaker, RefusesTooManyTrianglesAfterClipping) {
  const FrontendOptions options{.width = 9, .height = 9};
  const Scene scene;
  const TriangleStream stream;
  SceneMaker of_scene;
  StreamMaker of_stream;
  of_scene.set(scene, options, resolve(SimdTarget::best));
  of_stream.set(stream, options, resolve(SimdTarget::best));
  for (TriangleMaker* maker : std::initializer_list<TriangleMaker*>{&of_scene, &of_stream}) {
    maker->start_workers(2, 1, nullptr);
    maker->output(0).stats.emitted = kMaxTriangles;
    maker->finish();
    maker->output(1).stats.emitted = 1;
    EXPECT_EQ(message_of([&] { maker->finish(); }), "1073741825 triangles are more than 1073741824");
  }
}

}  // namespace
}  // namespace edgewise

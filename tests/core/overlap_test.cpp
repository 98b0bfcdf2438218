#include "core/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "core/random.h"
#include "edgewise/barycentrics.h"
#include "edgewise/draw.h"
#include "message_of.h"

namespace edgewise {
namespace {

std::set<const std::uint32_t*> elements_of(const Rows& rows) {
  std::set<const std::uint32_t*> elements;
  for (std::ptrdiff_t y = 0; y < rows.height; ++y)
    for (std::ptrdiff_t x = 0; x < rows.width; ++x)
      elements.insert(static_cast<const std::uint32_t*>(rows.first) + y * rows.stride + x);
  return elements;
}

TEST(Overlap, IsThatOfTheElementsIfStridesAreEqual) {
  Random random(5);
  const std::array<std::uint32_t, 160> memory{};
  int shared = 0, interleaved = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const auto up_to = [&](std::uint64_t most) {
      return static_cast<std::ptrdiff_t>(1 + random.below(most));
    };
    Rows a{&memory[random.below(60)], up_to(6), up_to(6), 0},
        b{&memory[random.below(60)], up_to(6), up_to(6), 0};
    a.stride = b.stride = std::max(a.width, b.width) + up_to(8) - 1;
    if (trial % 4 == 0) b.stride = b.width + up_to(8) - 1;
    const bool expected = std::ranges::any_of(
        elements_of(a), [in_b = elements_of(b)](const auto* element) { return in_b.contains(element); });
    const bool found = overlap(a, b);
    ASSERT_EQ(found, overlap(b, a)) << trial;
    ASSERT_TRUE(found == expected || (found && a.stride != b.stride)) << trial;
    shared += expected;
    interleaved += !found && a.address() < b.end() && b.address() < a.end();
  }
  EXPECT_GT(shared, 1000);
  EXPECT_GT(interleaved, 100);
}

TEST(Overlap, OfAFramesPlanesIsRefusedBeforeADraw) {
  constexpr int kSide = 20;
  std::vector<std::uint32_t> memory(3 * kSide * kSide, 7);
  const auto untouched = memory;
  const TriangleStream stream{kSide, kSide, {{{{0, 0, 0.5f}, {20, 0, 0.5f}, {0, 20, 0.5f}}, 1}}};
  const FrontendOptions options{.width = kSide, .height = kSide, .cull = Cull::none};
  const auto backend = find_backend("tiled").make();
  Frontend frontend;
  const auto messages = [&](std::ptrdiff_t payload, std::ptrdiff_t stride) {
    const FrameView frame{memory.data(), memory.data() + payload, kSide, kSide, stride};
    const std::string of_both = message_of([&] { draw(stream, frontend, options, *backend, frame); });
    EXPECT_EQ(message_of([&] { backend->draw(frontend.run(stream, options), frame); }), of_both);
    return of_both;
  };
  constexpr const char* kOverlap = "the frame's depth and payload overlap in memory";
  EXPECT_EQ(messages(kSide * kSide - 1, kSide), kOverlap);
  EXPECT_EQ(memory, untouched);
  EXPECT_EQ(messages(kSide, 2 * kSide), "") << "side by side";
}

TEST(Overlap, OfBarycentricsPlanesIsRefusedBeforeTheyAreWritten) {
  constexpr int kSide = 20, kPixels = kSide * kSide;
  std::vector<std::uint32_t> memory(6 * kPixels, contract::kDepthClear);  // background
  const auto untouched = memory;
  const ConstFrameView ids{memory.data(), memory.data() + kPixels, kSide, kSide, kSide};
  float *const depth = reinterpret_cast<float*>(memory.data()), *const free = depth + 2 * kPixels;
  const auto message = [&](const BarycentricsView& planes) {
    return message_of([&] {
      barycentrics(ids, TriangleStream{}, {.width = kSide, .height = kSide, .payload = Payload::id}, planes);
    });
  };
  constexpr const char* kOverlap =
      "barycentric coordinates need planes that overlap neither the frame nor each other";
  EXPECT_EQ(message({free - kSide, 2 * kSide, free + 3 * kPixels, kSide}), kOverlap) << "uv and payload";
  EXPECT_EQ(message({nullptr, 0, depth, kSide}), kOverlap) << "distance and depth";
  EXPECT_EQ(message({nullptr, 0, free - 1, kSide}), kOverlap) << "distance and payload";
  EXPECT_EQ(message({free, 2 * kSide, free + 2 * kPixels - 1, kSide}), kOverlap) << "uv and distance";
  EXPECT_EQ(memory, untouched);
  EXPECT_EQ(message({free, 3 * kSide, free + 2 * kSide, 3 * kSide}), "") << "side by side";
}

}  // namespace
}  // namespace edgewise

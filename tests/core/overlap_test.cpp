#include "core/overlap.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "edgewise/barycentrics.h"
#include "edgewise/draw.h"
#include "message_of.h"

namespace edgewise {
namespace {

// By marking the elements of one plane.
TEST(Overlap, IsThatOfTheElementsIfStridesAreEqual) {
  Random random(5);
  int apart = 0, shared = 0, interleaved = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const auto up_to = [&](std::uint64_t most) {
      return static_cast<std::ptrdiff_t>(1 + random.below(most));
    };
    std::array<std::uint32_t, 160> memory{};
    Rows a{&memory[random.below(60)], up_to(6), up_to(6), 0},
        b{&memory[random.below(60)], up_to(6), up_to(6), 0};
    a.stride = b.stride = std::max(a.width, b.width) + up_to(8) - 1;
    if (trial % 4 == 0) b.stride = b.width + up_to(8) - 1;
    const auto for_each = [&](const Rows& rows, auto&& visit) {
      for (std::ptrdiff_t y = 0; y < rows.height; ++y)
        for (std::ptrdiff_t x = 0; x < rows.width; ++x)
          visit(memory[static_cast<std::size_t>(static_cast<const std::uint32_t*>(rows.first) -
                                                memory.data() + y * rows.stride + x)]);
    };
    bool expected = false;
    for_each(a, [](std::uint32_t& element) { element = 1; });
    for_each(b, [&](const std::uint32_t& element) { expected = expected || element != 0; });
    const bool found = overlap(a, b);
    ASSERT_EQ(found, overlap(b, a)) << trial;
    ASSERT_TRUE(found || !expected) << trial;
    ASSERT_TRUE(found == expected || a.stride != b.stride) << trial;
    (expected ? shared : apart) += 1;
    interleaved += !found && a.address() < b.end() && b.address() < a.end();
  }
  EXPECT_GT(apart, 1000);
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
  EXPECT_EQ(messages(0, kSide), kOverlap);
  EXPECT_EQ(messages(kSide * kSide - 1, kSide), kOverlap);
  EXPECT_EQ(messages(kSide - 1, 2 * kSide), kOverlap);
  EXPECT_EQ(memory, untouched);
  EXPECT_EQ(messages(kSide * kSide, kSide), "");
  EXPECT_EQ(messages(kSide, 2 * kSide), "") << "side by side";
}

TEST(Overlap, OfBarycentricsPlanesIsRefusedBeforeTheyAreWritten) {
  constexpr int kSide = 20, kPixels = kSide * kSide;
  std::vector<std::uint32_t> memory(6 * kPixels, contract::kDepthClear);  // background
  const auto untouched = memory;
  const auto message = [&](std::ptrdiff_t uv, std::ptrdiff_t uv_stride, std::ptrdiff_t distance,
                           std::ptrdiff_t distance_stride) {
    auto* const floats = reinterpret_cast<float*>(memory.data());
    const ConstFrameView ids{memory.data(), memory.data() + kPixels, kSide, kSide, kSide};
    return message_of([&] {
      barycentrics(ids, TriangleStream{}, {.width = kSide, .height = kSide, .payload = Payload::id},
                   {uv >= 0 ? floats + uv : nullptr, uv_stride, floats + distance, distance_stride});
    });
  };
  constexpr const char* kOverlap =
      "barycentric coordinates need planes that overlap neither the frame nor each other";
  EXPECT_EQ(message(kPixels - kSide, 2 * kSide, 5 * kPixels, kSide), kOverlap) << "uv and payload";
  EXPECT_EQ(message(-1, 0, 0, kSide), kOverlap) << "distance and depth";
  EXPECT_EQ(message(-1, 0, 2 * kPixels - 1, kSide), kOverlap) << "distance and payload";
  EXPECT_EQ(message(2 * kPixels, 2 * kSide, 4 * kPixels - 1, kSide), kOverlap) << "uv and distance";
  EXPECT_EQ(memory, untouched);
  EXPECT_EQ(message(2 * kPixels, 2 * kSide, 4 * kPixels, kSide), "");
  EXPECT_EQ(message(2 * kPixels, 3 * kSide, 2 * kPixels + 2 * kSide, 3 * kSide), "") << "side by side";
}

}  // namespace
}  // namespace edgewise

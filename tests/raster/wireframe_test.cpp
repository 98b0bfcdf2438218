// Properties of the line rule: shared edges, split edges, no gaps. backends_test.cpp compares the pixels with
// the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "core/random.h"
#include "edgewise/contract.h"
#include "support.h"

namespace edgewise {
namespace {

using namespace contract;

constexpr int kWidth = 90, kHeight = 70;
constexpr std::uint32_t kEdgeDepth = kDepthHead + 1000;

struct Point {
  std::int32_t x, y;  // 2^-15 px
};
using Pixels = std::set<std::pair<int, int>>;

// The pixels of the edge from a to b of a triangle whose third vertex is far away and far behind.
Pixels edge_pixels(Backend& backend, Point a, Point b, Point third) {
  Framebuffer frame(kWidth, kHeight);
  const ScreenTriangle triangle{
      {a.x, b.x, third.x}, {a.y, b.y, third.y}, {kEdgeDepth, kEdgeDepth, kDepthHead + kDepthRange}, 1};
  if (signed_area(triangle) != 0) backend.draw({&triangle, 1}, frame.view());
  Pixels pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (frame.depth_row(y)[x] == kEdgeDepth) pixels.insert({x, y});
  return pixels;
}

TEST(Wireframe, DrawsAnEdgeTheSameFromBothSidesAndInParts) {
  const auto backend = wireframe().make();
  const Point above{-kGuard_q15, -kGuard_q15 + 1}, below{kGuard_q15, kGuard_q15 - 2};
  Random random(17);
  const auto pixel = [](Point p) { return std::pair(p.x / kPixel_q15, p.y / kPixel_q15); };
  for (int i = 0; i < 4000; ++i) {
    const auto half = [&](int side) { return testing::between(random, 0, side * kPixel_q15 / 2 - 1); };
    const Point a{2 * half(kWidth), 2 * half(kHeight)}, b{2 * half(kWidth), 2 * half(kHeight)},
        middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    Pixels whole = edge_pixels(*backend, a, b, above);
    if (whole.empty()) continue;  // no area
    ASSERT_EQ(whole, edge_pixels(*backend, b, a, below)) << i;
    ASSERT_TRUE(whole.contains(pixel(a)) && whole.contains(pixel(b))) << i;
    const auto [ax, ay] = pixel(a);
    const auto [bx, by] = pixel(b);
    ASSERT_GT(whole.size(), static_cast<std::size_t>(std::max(std::abs(ax - bx), std::abs(ay - by)))) << i;

    // A vertex in the middle adds at most its pixel.
    Pixels parts = edge_pixels(*backend, a, middle, above);
    parts.merge(edge_pixels(*backend, middle, b, above));
    parts.insert(pixel(middle)), whole.insert(pixel(middle));
    ASSERT_EQ(whole, parts) << i;
  }
}

}  // namespace
}  // namespace edgewise

// Properties of the line rule: shared edges, split edges, and outlines without gaps. backends_test.cpp
// compares the pixels with the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "core/random.h"
#include "edgewise/contract.h"
#include "support.h"

namespace edgewise {
namespace {

using namespace contract;

constexpr std::uint32_t kNothing = 0xFFFFFFFF;

struct Drawn {
  int x, y;
  std::uint32_t z;
  auto operator<=>(const Drawn&) const = default;
};
using Pixels = std::set<Drawn>;

class Wireframe : public ::testing::Test {
 protected:
  static constexpr int kWidth = 90, kHeight = 70;

  Pixels drawn(std::span<const ScreenTriangle> triangles, int width = kWidth, int height = kHeight) {
    Framebuffer frame(width, height);
    backend_->draw(triangles, frame.view(), {kNothing});
    Pixels pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (frame.payload_row(y)[x] != kNothing) pixels.insert({x, y, frame.depth_row(y)[x]});
    return pixels;
  }
  Pixels drawn(const ScreenTriangle& triangle) { return drawn({&triangle, 1}); }

  std::int32_t between(std::int32_t low, std::int32_t high) { return testing::between(random_, low, high); }
  std::uint32_t depth() { return kDepthHead + static_cast<std::uint32_t>(random_.below(kDepthRange + 1ull)); }

  Random random_{17};
  std::unique_ptr<Backend> backend_ = wireframe().make();
};

// The third vertices lie so far away that the triangles' other edges touch only the ends of the shared edge.
TEST_F(Wireframe, NeighboursDrawTheirSharedEdgeTheSame) {
  for (int i = 0; i < 3000; ++i) {
    const std::int32_t x0 = between(0, kWidth * kSub - 1), y0 = between(0, kHeight * kSub - 1);
    const std::int32_t x1 = between(0, kWidth * kSub - 1), y1 = between(0, kHeight * kSub - 1);
    const std::uint32_t z0 = depth(), z1 = depth();
    const bool flat = std::abs(x1 - x0) >= std::abs(y1 - y0);
    ScreenTriangle one{{x0, x1, x1}, {y0, y1, y1}, {z0, z1, z1}, 1},
        other{{x1, x0, x0}, {y1, y0, y0}, {z1, z0, z0}, 2};
    (flat ? one.y_sub : one.x_sub)[2] = -kGuardSub;
    (flat ? other.y_sub : other.x_sub)[2] = kGuardSub;
    const int low = (flat ? std::min(x0, x1) : std::min(y0, y1)) / kSub + 2,
              high = (flat ? std::max(x0, x1) : std::max(y0, y1)) / kSub - 1;
    const auto inner = [&](Pixels pixels) {
      std::erase_if(pixels,
                    [&](const Drawn& p) { return (flat ? p.x : p.y) < low || (flat ? p.x : p.y) >= high; });
      return pixels;
    };
    const Pixels by_one = inner(drawn(one)), by_other = inner(drawn(other));
    ASSERT_EQ(by_one, by_other) << i;
    if (high > low) {
      ASSERT_EQ(by_one.size(), static_cast<std::size_t>(high - low)) << i;
    }
  }
}

bool touch(const Drawn& a, const Drawn& b) {
  return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1;
}

// Whether the pixels are 8-connected.
bool connected(Pixels pixels) {
  std::vector<Drawn> frontier;
  const auto visit = [&](Pixels::iterator p) {
    frontier.push_back(*p);
    return pixels.erase(p);
  };
  if (!pixels.empty()) visit(pixels.begin());
  while (!frontier.empty()) {
    const Drawn at = frontier.back();
    frontier.pop_back();
    for (auto p = pixels.lower_bound({at.x - 1, at.y - 1, 0}); p != pixels.end() && p->x <= at.x + 1;)
      p = touch(*p, at) ? visit(p) : std::next(p);
  }
  return pixels.empty();
}

TEST_F(Wireframe, DrawsConnectedOutlinesThroughTheVertices) {
  for (int i = 0; i < 2000; ++i) {
    ScreenTriangle t{{}, {}, {}, 1};
    const std::int32_t reach = i % 3 == 0 ? 300 : i % 3 == 1 ? 2000 : 17'000;
    for (int k = 0; k < 3; ++k) {
      t.x_sub[k] = std::clamp(between(-reach, reach) + kWidth * kSub / 2, 0, kWidth * kSub - 1);
      t.y_sub[k] = std::clamp(between(-reach, reach) + kHeight * kSub / 2, 0, kHeight * kSub - 1);
      t.z[k] = depth();
    }
    const Pixels pixels = drawn(t);
    ASSERT_TRUE(connected(pixels)) << i;
    if (signed_area(t) == 0) {
      ASSERT_TRUE(pixels.empty()) << i;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const Drawn vertex{t.x_sub[k] / kSub, t.y_sub[k] / kSub, t.z[k]};
      const auto at = pixels.lower_bound({vertex.x, vertex.y, 0});
      ASSERT_TRUE(at != pixels.end() && at->x == vertex.x && at->y == vertex.y && at->z <= vertex.z) << i;
    }
  }
}

// A vertex in the middle of an edge splits its pixels, and adds at most the vertex's pixel.
TEST_F(Wireframe, DrawsASplitEdgeLikeTheWholeEdge) {
  for (int i = 0; i < 2000; ++i) {
    const std::int32_t ax = between(0, kWidth * kSub / 2), ay = between(0, kHeight * kSub / 2);
    const std::int32_t dx = between(1, kWidth * kSub / 4), dy = between(0, kHeight * kSub / 4);
    const std::uint32_t z = 1000;
    const auto with_third = [&](std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) {
      return ScreenTriangle{{x0, x1, -kGuardSub}, {y0, y1, -kGuardSub}, {z, z, kDepthHead + kDepthRange}, 1};
    };
    const ScreenTriangle whole = with_third(ax, ay, ax + 2 * dx, ay + 2 * dy);
    const ScreenTriangle halves[] = {with_third(ax, ay, ax + dx, ay + dy),
                                     with_third(ax + dx, ay + dy, ax + 2 * dx, ay + 2 * dy)};
    const auto on_edge = [&](Pixels pixels) {
      std::erase_if(pixels, [&](const Drawn& p) { return p.z != z; });
      return pixels;
    };
    Pixels cut = on_edge(drawn(halves)), uncut = on_edge(drawn(whole));
    const Drawn vertex{(ax + dx) / kSub, (ay + dy) / kSub, z};
    cut.insert(vertex), uncut.insert(vertex);
    if (signed_area(whole) == 0) continue;
    ASSERT_EQ(cut, uncut) << i;
  }
}

}  // namespace
}  // namespace edgewise

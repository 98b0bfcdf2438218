// Triangles constructed, by hand or by number theory, to expose the smallest error in a backend's arithmetic.
#include <array>
#include <numeric>
#include <tuple>

#include "every_backend.h"

namespace edgewise {
namespace {

using namespace contract;
using testing::between;
using testing::coarse;
using testing::EveryBackend;

// a^-1 mod m, for coprime a and m.
std::int64_t inverse(std::int64_t a, std::int64_t m) {
  std::int64_t r0 = m, r1 = a % m, t0 = 0, t1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    std::tie(r0, r1) = std::pair(r1, r0 - q * r1);
    std::tie(t0, t1) = std::pair(t1, t0 - q * t1);
  }
  return (t0 + m) % m;
}

struct EdgeStart {
  std::int32_t x, y, dx;  // sub-units; dx to the edge's end
};
// The start p of an edge of height `dy` sub-units that crosses the sample's row rest / (256 dy) px to the
// right of the sample: (p.x - sample_x) dy + n dx = rest, where p is n >= dy / 2 sub-units above the sample.
EdgeStart edge_beside(std::int32_t sample_x, std::int32_t sample_y, std::int64_t rest, std::int64_t dy) {
  std::int64_t n = dy / 2;
  while (std::gcd(n, dy) != 1) ++n;  // moves p up
  std::int64_t dx = (rest + dy) * inverse(n, dy) % dy;
  if (dx > dy / 2) dx -= dy;
  const auto left = (rest - n * dx) / dy;
  EXPECT_EQ(left * dy + n * dx, rest);
  return {sample_x + static_cast<std::int32_t>(left), sample_y - static_cast<std::int32_t>(n),
          static_cast<std::int32_t>(dx)};
}

TEST_P(EveryBackend, ResolvesEdgesNextToASample) {
  struct Case {
    int side;  // of the image, px
    std::vector<std::int32_t> heights;
    std::vector<std::int64_t> rests;
    std::int32_t right, down;  // from the edge to the third vertex, sub-units
  };
  // Tall edges; then sides just below 16 px, the steepest edges that small triangles can have. An edge's
  // value is rounded down to whole pixels: 0 … 255 count as 0.
  const Case cases[] = {{70,
                         {2 * Coarse::kGuardSub - 40'001, Coarse::kGuardSub + 1, 131'071, 8'191},
                         {-1, 0, 1},
                         2 * Coarse::kGuardSub,
                         1000},
                        {8, {4'095, 4'093, 2'731}, {-256, -255, -1, 0, 1, 255, 256}, 1'900, 700}};
  for (const auto& [side, heights, rests, right, down] : cases)
    for (const std::int32_t dy : heights)
      for (const std::int64_t rest : rests)
        for (const int row : {0, side / 2, side - 1})
          for (const bool across : {false, true}) {
            const auto [x, y, dx] =
                edge_beside(Coarse::sample(row * 5 % side), Coarse::sample(row), rest, dy);
            for (const std::int32_t third_x : {std::min(x, x + dx) - right, std::max(x, x + dx) + right}) {
              ScreenTriangle t =
                  coarse({{x, x + dx, std::clamp(third_x, -Coarse::kGuardSub, Coarse::kGuardSub)},
                          {y, y + dy, y + down},
                          {5000, 6000, 7000},
                          1});
              if (across) std::swap(t.x_q15, t.y_q15);
              expect_oracle(std::span(&t, 1), side, side, std::to_string(dy) + ", " + std::to_string(rest));
            }
          }
}

// A triangle with its right angle at the upper left and depth z(x, y) at its vertices; all in px. By default
// it covers the whole image.
template <typename Depth>
ScreenTriangle right_triangle(const Depth& z, int id, int left = -100, int right = 400, int bottom = 400) {
  constexpr int kTop = -100;
  return {{left * kPixel_q15, right * kPixel_q15, left * kPixel_q15},
          {kTop * kPixel_q15, kTop * kPixel_q15, bottom * kPixel_q15},
          {z(left, kTop), z(right, kTop), z(left, bottom)},
          static_cast<std::uint32_t>(id)};
}
auto at_depth(std::uint32_t z) {
  return [z](int, int) { return z; };
}

TEST_P(EveryBackend, ResolvesLayersOneDepthUnitApart) {
  // Parallel planes over the whole image in groups of three: one nearer by one unit, one behind it, and one
  // at equal depth. A block's zmax that is wrong by one occludes a layer.
  constexpr int kWidth = 97, kHeight = 71, kLayers = 12;
  for (const int slope : {0, 1, -3}) {
    std::vector<ScreenTriangle> layers;
    for (int id = 0; id < kLayers; ++id) {
      const auto z = [&](int x, int y) {
        return static_cast<std::uint32_t>(10'000 - id / 3 + (id % 3 == 1) + slope * (x + y));
      };
      layers.push_back(right_triangle(z, id));
    }
    expect_oracle(layers, kWidth, kHeight, "slope " + std::to_string(slope));
  }
}

TEST_P(EveryBackend, DrawsTrianglesVisibleInOneCornerOfATile) {
  // A layer over the whole image, a triangle in front of the first blocks or of all but the last, and a
  // plane. The plane's nearest depth is one unit nearer than the layer, in a corner or along a side of the
  // first tile, or everywhere. It may begin inside the tile.
  constexpr int kWidth = 97, kHeight = 71, kLast = kMaxTile - 1;
  constexpr std::uint32_t kLayer = 1'000'000;
  for (const int reach : {50, 118})
    for (const int across : {-10, 0, 10})
      for (const int down : {-10, 0, 10}) {
        const int x = across < 0 ? kLast : 0, y = down < 0 ? kLast : 0;
        const auto plane = [&](int u, int v) {
          return static_cast<std::uint32_t>(static_cast<int>(kLayer) - 1 - (across + down) / 2 +
                                            across * (u - x) + down * (v - y));
        };
        // The longest side of the second triangle is the line u + v = reach.
        const ScreenTriangle triangles[] = {
            right_triangle(at_depth(kLayer), 1),
            right_triangle(at_depth(kLayer / 2), 2, -100, reach + 100, reach + 100),
            right_triangle(plane, 3, across < 0 ? 8 : -100)};
        const Framebuffer picture = oracle(triangles, kWidth, kHeight);
        const std::string what =
            std::to_string(reach) + ", " + std::to_string(across) + ", " + std::to_string(down);
        if (fills_) {
          const bool covered = x + y < reach;
          EXPECT_EQ(picture.payload_row(y)[x], covered ? 2 : 3) << what;
          EXPECT_EQ(picture.depth_row(y)[x], covered ? kLayer / 2 : kLayer - 1) << what;
        }
        expect_oracle(triangles, kWidth, kHeight, what);
      }
}

TEST_P(EveryBackend, DrawsSteepTrianglesWhoseDepthPlanesWrap) {
  // Thin triangles across a tile, from the nearest to the farthest depth within few pixels, in front of a
  // layer. In the bounding box their planes exceed 32 bits many times over.
  constexpr int kWidth = 64, kHeight = 64;
  Random random(17);
  const ScreenTriangle layer = right_triangle(at_depth(kDepthRange / 2), 1);
  for (int i = 0; i < 200; ++i) {
    const std::int32_t x = between(random, 0, 4 * Coarse::kSub), y = between(random, 0, 63 * Coarse::kSub);
    const ScreenTriangle thin =
        coarse({{x, between(random, 57 * Coarse::kSub, 63 * Coarse::kSub), x + between(random, -500, 500)},
                {y, between(random, 0, 63 * Coarse::kSub), y + between(random, 100, 1000)},
                {kDepthHead, kDepthHead, kDepthHead + kDepthRange},
                2});
    expect_oracle(std::array{layer, thin}, kWidth, kHeight, std::to_string(i));
  }
}

TEST_P(EveryBackend, AnchorsDepthAtTheTopmostThenLeftmostVertex) {
  // Gradients are rounded down, so over the width of the guard band a different anchor gives different
  // depths.
  constexpr int kWidth = 70, kHeight = 5;
  Random random(13);
  for (std::uint32_t id = 0; id < 100; ++id) {
    const std::int32_t top = between(random, -Coarse::kGuardSub, -Coarse::kGuardSub / 2),
                       far = between(random, Coarse::kGuardSub / 2, Coarse::kGuardSub);
    ScreenTriangle t = coarse({{-far, far, between(random, -far, far)},
                               {top, id % 2 == 0 ? top : top + between(random, 0, 1000), Coarse::kGuardSub},
                               {},
                               id});
    for (auto& z : t.z) z = kDepthHead + static_cast<std::uint32_t>(random.below(kDepthRange + 1ull));
    for (auto* field : {t.x_q15, t.y_q15}) std::rotate(field, field + id % 3, field + 3);
    expect_oracle(std::span(&t, 1), kWidth, kHeight, std::to_string(id));
  }
}

}  // namespace
}  // namespace edgewise

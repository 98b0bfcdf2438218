// Triangles constructed, by hand or by number theory, to expose the smallest error in a backend's arithmetic.
#include <array>
#include <numeric>
#include <tuple>

#include "every_backend.h"

namespace edgewise {
namespace {

using namespace contract;
using testing::between;
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
// The start p of an edge of height `dy` sub-units that crosses the sample's row rest / (kSub dy) px to the
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

// Calls check(triangle, side of the image, description) for edges that are two sub-units high. If its samples
// are 2^12 px per row apart or more, the spans at an edge are found by division.
template <class G, typename Check>
void for_each_flat_edge_next_to_a_sample(Check&& check) {
  constexpr int kSide = 70;
  constexpr std::int32_t kSample = G::sample(kSide / 2), kDown = 4 * G::kSub;
  for (const std::int32_t length : {1 << 12, 1 << 13, 3 << 14, G::kGuardSub})
    for (const std::int32_t rest : {-1, 0, 1})
      for (const std::int32_t up : {-1, 1})
        for (const std::int32_t down : {-kDown, kDown}) {
          const std::int32_t width = length + (rest & 1), x = kSample - (width + rest) / 2;
          check(testing::on_grid<G>({{x, x + width, kSample},
                                     {kSample - up, kSample + up, kSample + down},
                                     {5000, 6000, 7000},
                                     1}),
                kSide,
                std::to_string(G::kSubBits) + " bits, flat, " + std::to_string(length) + ", " +
                    std::to_string(rest));
        }
}

// Calls check as above.
template <class G, typename Check>
void for_each_edge_next_to_a_sample(Check&& check) {
  struct Case {
    int side;  // of the image, px
    std::vector<std::int32_t> heights;
    std::vector<std::int64_t> rests;
    std::int32_t right, down;  // from the edge to the third vertex, sub-units
  };
  // Tall edges; then sides just below 16 px, the steepest edges that small triangles can have. An edge's
  // value is rounded down to whole pixels: 0 … kSub - 1 count as 0.
  constexpr std::int32_t kSub = G::kSub, kGuard = G::kGuardSub;
  const Case cases[] = {
      {70,
       {2 * kGuard - 160 * kSub + 1, kGuard + 1, kGuard / 2 - 1, 512 * kSub - 1, 32 * kSub - 1},
       {-1, 0, 1},
       2 * kGuard,
       4 * kSub},
      {8,
       {16 * kSub - 1, 16 * kSub - 3, 11 * kSub - 5},
       {-kSub, 1 - kSub, -1, 0, 1, kSub - 1, kSub},
       7 * kSub,
       3 * kSub}};
  for (const auto& [side, heights, rests, right, down] : cases)
    for (const std::int32_t dy : heights)
      for (const std::int64_t rest : rests)
        for (const int row : {0, side / 2, side - 1})
          for (const bool across : {false, true}) {
            const auto [x, y, dx] = edge_beside(G::sample(row * 5 % side), G::sample(row), rest, dy);
            for (const std::int32_t third_x : {std::min(x, x + dx) - right, std::max(x, x + dx) + right}) {
              ScreenTriangle t = testing::on_grid<G>({{x, x + dx, std::clamp(third_x, -kGuard, kGuard)},
                                                      {y, y + dy, y + down},
                                                      {5000, 6000, 7000},
                                                      1});
              if (across) std::swap(t.x_q15, t.y_q15);
              check(
                  t, side,
                  std::to_string(G::kSubBits) + " bits, " + std::to_string(dy) + ", " + std::to_string(rest));
            }
          }
  for_each_flat_edge_next_to_a_sample<G>(check);
}

TEST_P(EveryBackend, ResolvesEdgesNextToASample) {
  testing::for_each_grid([&](auto grid) {
    for_each_edge_next_to_a_sample<decltype(grid)>(
        [&](const ScreenTriangle& triangle, int side, const std::string& what) {
          expect_oracle(std::span(&triangle, 1), side, side, what);
        });
  });
}

TEST(Compositions, ResolveEdgesNextToASample) {
  for (const BackendInfo& info : compositions()) {
    const auto backend = info.make();
    testing::for_each_grid([&](auto grid) {
      for_each_edge_next_to_a_sample<decltype(grid)>([&](const ScreenTriangle& triangle, int side,
                                                         const std::string& what) {
        Framebuffer expected(side, side), found(side, side);
        lab::draw_oracle(std::span(&triangle, 1), expected, testing::kBackground);
        for (const SimdTarget target : supported_targets()) {
          const Execution execution{1, 64, target};
          backend->draw(std::span(&triangle, 1), found.view(), {testing::kBackground}, execution);
          testing::expect_same(expected, found,
                               std::string(info.name) + ", " + what + ", " + testing::describe(execution));
        }
      });
    });
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
  testing::for_each_grid([&](auto grid) {
    using G = decltype(grid);
    for (int i = 0; i < 200; ++i) {
      const std::int32_t x = between(random, 0, 4 * G::kSub), y = between(random, 0, 63 * G::kSub);
      const ScreenTriangle thin = testing::on_grid<G>(
          {{x, between(random, 57 * G::kSub, 63 * G::kSub), x + between(random, -2 * G::kSub, 2 * G::kSub)},
           {y, between(random, 0, 63 * G::kSub), y + between(random, G::kSub / 2, 4 * G::kSub)},
           {kDepthHead, kDepthHead, kDepthHead + kDepthRange},
           2});
      expect_oracle(std::array{layer, thin}, kWidth, kHeight, std::to_string(i));
    }
  });
}

TEST_P(EveryBackend, AnchorsDepthAtTheTopmostThenLeftmostVertex) {
  // Gradients are rounded down, so over the width of the guard band a different anchor gives different
  // depths.
  constexpr int kWidth = 70, kHeight = 5;
  Random random(13);
  testing::for_each_grid([&](auto grid) {
    using G = decltype(grid);
    for (std::uint32_t id = 0; id < 100; ++id) {
      const std::int32_t top = between(random, -G::kGuardSub, -G::kGuardSub / 2),
                         far = between(random, G::kGuardSub / 2, G::kGuardSub);
      ScreenTriangle t =
          testing::on_grid<G>({{-far, far, between(random, -far, far)},
                               {top, id % 2 == 0 ? top : top + between(random, 0, 4 * G::kSub), G::kGuardSub},
                               {},
                               id});
      for (auto& z : t.z) z = kDepthHead + static_cast<std::uint32_t>(random.below(kDepthRange + 1ull));
      for (auto* field : {t.x_q15, t.y_q15}) std::rotate(field, field + id % 3, field + 3);
      expect_oracle(std::span(&t, 1), kWidth, kHeight, std::to_string(id));
    }
  });
}

}  // namespace
}  // namespace edgewise

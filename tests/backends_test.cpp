// Every backend in the registry, under every execution, against the brute-force oracle.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

#include "lab/measure.h"
#include "lab/oracle.h"
#include "support.h"

namespace edgewise {
namespace {

using namespace contract;
using testing::adversarial;
using testing::kBackground;

class EveryBackend : public ::testing::TestWithParam<std::string_view> {
 protected:
  const BackendInfo& info_ = find_backend(GetParam());
  std::unique_ptr<Backend> backend_ = info_.make();

  Framebuffer oracle(std::span<const ScreenTriangle> triangles, int width, int height) const {
    Framebuffer expected(width, height);
    (info_.fills ? lab::draw_oracle : lab::draw_edge_oracle)(triangles, expected, kBackground);
    return expected;
  }
  void expect_oracle(std::span<const ScreenTriangle> triangles, int width, int height,
                     const std::string& what) {
    const Framebuffer expected = oracle(triangles, width, height);
    Framebuffer actual(width, height);
    for (const auto& execution : testing::executions()) {
      lab::poison(actual);  // or what is left out would still be right, from the draw before
      backend_->draw(triangles, actual.view(), kBackground, execution);
      testing::expect_same(expected, actual, what + ", " + testing::describe(execution));
    }
  }
};

TEST_P(EveryBackend, DrawsTheOraclesPictureForEveryFamily) {
  for (const auto family : testing::kFamilies)
    for (const int count : {1, 7, 200})
      expect_oracle(adversarial(family, count, 97, 71, static_cast<std::uint64_t>(count)), 97, 71,
                    std::string(family));
}

TEST_P(EveryBackend, DrawsTheOraclesPictureAtEverySize) {
  for (const auto& [width, height] : {std::pair{1, 1},
                                      {1, 64},
                                      {64, 1},
                                      {3, 5},
                                      {16, 16},
                                      {17, 15},
                                      {63, 65},
                                      {64, 64},
                                      {129, 33},
                                      {200, 130}})
    for (const auto family : {"subpixel", "huge", "tiny"})
      expect_oracle(adversarial(family, 40, width, height, 11), width, height,
                    std::to_string(width) + "x" + std::to_string(height));
}

TEST_P(EveryBackend, DrawsTheOraclesPictureWhenTrianglesFillManyChunks) {
  // More than one bin chunk and bin block, in a small image so that the oracle can follow.
  auto triangles = adversarial("tiny", 12'000, 40, 40, 3);
  const auto big = adversarial("subpixel", 20, 40, 40, 4);
  triangles.insert(triangles.begin() + 6'000, big.begin(), big.end());
  expect_oracle(triangles, 40, 40, "many chunks");
  // Where all depths tie, the order of the chunks decides.
  expect_oracle(adversarial("equal-depth", 3'000, 40, 40, 5), 40, 40, "many chunks at one depth");
}

TEST_P(EveryBackend, ForgetsTheFrameBefore) {
  const int width = 150, height = 90;
  const auto small = adversarial("few-pixels", 40, width, height, 1);
  const auto large = adversarial("subpixel", 160, width, height, 2);
  const auto joined = [](std::vector<ScreenTriangle> first, const std::vector<ScreenTriangle>& then) {
    first.insert(first.end(), then.begin(), then.end());
    return first;
  };
  // Small ones take another way than large ones.
  const std::vector<ScreenTriangle> frames[] = {joined(small, large), joined(large, small), large, small};
  std::vector<Framebuffer> expected;
  for (const auto& triangles : frames) expected.push_back(oracle(triangles, width, height));
  for (const auto& execution : testing::executions())
    for (const std::size_t i : {0u, 1u, 2u, 3u, 1u, 0u, 3u, 2u, 0u}) {
      Framebuffer actual(width, height);
      backend_->draw(frames[i], actual.view(), kBackground, execution);
      testing::expect_same(expected[i], actual, std::to_string(i) + ", " + testing::describe(execution));
    }
}

TEST_P(EveryBackend, DrawsTheOraclesPictureWhenPatchesTakeTooMuchMemory) {
  // Eight pixels wide and high at most: small, but most of them in more than two windows of 8 x 8.
  std::vector<ScreenTriangle> triangles(12'000);
  std::uint32_t random = 1;
  const auto below = [&](int end) {
    random = random * 1664525u + 1013904223u;
    return static_cast<std::int32_t>((random >> 8) % static_cast<unsigned>(end));
  };
  for (auto& t : triangles) {
    const std::int32_t side = 2000, x = below(90 * kSub), y = below(70 * kSub);
    t = {{x, x + side, x + below(side)},
         {y, y + below(side), y + side},
         {},
         static_cast<std::uint32_t>(&t - triangles.data())};
    for (auto& z : t.z) z = kDepthHead + static_cast<std::uint32_t>(below(1000));
  }
  expect_oracle(triangles, 97, 71, "patches of 8 x 8 pixels");
}

TEST_P(EveryBackend, ReachesTheFarCornerOfTheLargestImage) {
  for (const auto& [width, height] : {std::pair{kMaxImageSide, 3}, {3, kMaxImageSide}})
    expect_oracle(adversarial("subpixel", 6, width, height, 2), width, height, "largest side");
}

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

std::int32_t i32(std::int64_t v) {
  return static_cast<std::int32_t>(v);
}

struct EdgeStart {
  std::int64_t x, y, dx;  // sub-units; dx to the edge's end
};
// Of an edge, `dy` sub-units high, that crosses a sample's height rest / (256 dy) px to its right: from
// vertex p, n sub-units above, by (p.x - sample_x) dy + n dx = rest. `above`: the least n.
EdgeStart edge_beside(std::int32_t sample_x, std::int32_t sample_y, std::int64_t rest, std::int32_t dy,
                      std::int64_t above) {
  std::int64_t n = above;
  while (std::gcd(n, std::int64_t{dy}) != 1) ++n;  // puts p higher
  std::int64_t dx = (rest + dy) * inverse(n, dy) % dy;
  if (dx > dy / 2) dx -= dy;
  return {sample_x + (rest - n * dx) / dy, sample_y - n, dx};
}

TEST_P(EveryBackend, TellsTheLeastDistanceBetweenTheTallestEdgesAndASample) {
  constexpr int kWidth = 80, kHeight = 70;
  std::vector<ScreenTriangle> triangles;
  std::uint32_t id = 0;
  for (const std::int32_t dy : {2 * kGuardSub - 101, kGuardSub + 1, 131'071, 8'191})
    for (const int y : {0, 33, 69})
      for (const std::int64_t rest : {-1, 0, 1})
        for (const int third_x : {-kGuardSub, kGuardSub}) {
          const std::int32_t sample_x = sample_sub(y * 7 % kWidth), sample_y = sample_sub(y), top = -dy / 2;
          const auto [px, py, dx] = edge_beside(sample_x, sample_y, rest, dy, sample_y - top);
          ASSERT_EQ((px - sample_x) * dy + (sample_y - py) * dx, rest);
          triangles.push_back(
              {{i32(px), i32(px + dx), third_x}, {i32(py), i32(py + dy), 1000}, {5000, 6000 + id, 7000}, id});
          ++id;
        }
  for (const auto& t : triangles) expect_oracle(std::span(&t, 1), kWidth, kHeight, std::to_string(t.payload));
}

TEST_P(EveryBackend, TellsTheLeastDistanceBetweenSmallTrianglesAndASample) {
  // Sides just short of 16 px, of which an image of 8 x 8 px shows a part: as steep as edges
  // of small triangles can be. An edge's value is cut to whole pixels: 0 … 255 count as 0.
  constexpr int kSide = 8;
  std::vector<ScreenTriangle> triangles;
  for (const std::int32_t dy : {4'095, 4'093, 2'731})
    for (const int x : {0, 4, 7})
      for (const int y : {0, 3, 7})
        for (const std::int64_t rest : {-256, -255, -1, 0, 1, 255, 256})
          for (const bool across : {false, true}) {
            const auto [px, py, dx] = edge_beside(sample_sub(x), sample_sub(y), rest, dy, dy / 2);
            ASSERT_EQ((px - sample_sub(x)) * dy + (sample_sub(y) - py) * dx, rest);
            for (const std::int64_t third_x :
                 {std::min(px, px + dx) - 1'900, std::max(px, px + dx) + 1'900}) {
              ScreenTriangle t{{i32(px), i32(px + dx), i32(third_x)},
                               {i32(py), i32(py + dy), i32(py + 700)},
                               {5000, 6000, 7000},
                               static_cast<std::uint32_t>(triangles.size())};
              if (across) std::swap(t.x_sub, t.y_sub);
              triangles.push_back(t);
            }
          }
  for (const auto& t : triangles) expect_oracle(std::span(&t, 1), kSide, kSide, std::to_string(t.payload));
}

// With a right angle at the upper left, where z(x, y) is the depth at a vertex; all in px. Over the whole
// image, unless told.
template <typename Depth>
ScreenTriangle right_triangle(const Depth& z, int id, int left = -100, int right = 400, int bottom = 400) {
  constexpr int kTop = -100;
  return {{left * kSub, right * kSub, left * kSub},
          {kTop * kSub, kTop * kSub, bottom * kSub},
          {z(left, kTop), z(right, kTop), z(left, bottom)},
          static_cast<std::uint32_t>(id)};
}
auto at_depth(std::uint32_t z) {
  return [z](int, int) { return z; };
}

TEST_P(EveryBackend, TellsLayersThatAreOneUnitOfDepthApart) {
  // Parallel planes over the whole image, every third nearer by one, then one behind it and one that ties: a
  // bound on a block's depths that errs by one hides a layer.
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

TEST_P(EveryBackend, ShowsWhatIsNearerInOneCornerOfATile) {
  // A layer over the whole image, a triangle before the first blocks, or all but the last, and a plane that
  // is nearer than the layer by one where it is nearest, in a corner or along a side of the first tile, or
  // everywhere; it may begin inside the tile.
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
        // The second one's third side is the line u + v = reach.
        const ScreenTriangle triangles[] = {
            right_triangle(at_depth(kLayer), 1),
            right_triangle(at_depth(kLayer / 2), 2, -100, reach + 100, reach + 100),
            right_triangle(plane, 3, across < 0 ? 8 : -100)};
        const Framebuffer picture = oracle(triangles, kWidth, kHeight);
        const std::string what =
            std::to_string(reach) + ", " + std::to_string(across) + ", " + std::to_string(down);
        if (info_.fills) {
          const bool covered = x + y < reach;
          EXPECT_EQ(picture.payload_row(y)[x], covered ? 2 : 3) << what;
          EXPECT_EQ(picture.depth_row(y)[x], covered ? kLayer / 2 : kLayer - 1) << what;
        }
        expect_oracle(triangles, kWidth, kHeight, what);
      }
}

TEST_P(EveryBackend, ShowsSteepTrianglesWhoseDepthPlanesLeaveTheirRange) {
  // Thin triangles across a tile, from the nearest depth to the farthest within few pixels, before a layer:
  // over the box their planes pass 32 bits many times.
  constexpr int kWidth = 64, kHeight = 64;
  Random random(17);
  const auto between = [&](int low, int high) {
    return low + static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
  };
  const ScreenTriangle layer = right_triangle(at_depth(kDepthRange / 2), 1);
  for (int i = 0; i < 200; ++i) {
    const std::int32_t x = between(0, 4 * kSub), y = between(0, 63 * kSub);
    const ScreenTriangle thin{{x, between(57 * kSub, 63 * kSub), x + between(-500, 500)},
                              {y, between(0, 63 * kSub), y + between(100, 1000)},
                              {kDepthHead, kDepthHead, kDepthHead + kDepthRange},
                              2};
    expect_oracle(std::array{layer, thin}, kWidth, kHeight, std::to_string(i));
  }
}

TEST_P(EveryBackend, AnchorsDepthAtTheTopmostThenLeftmostVertex) {
  // Gradients are rounded down, so over the width of the guard band another anchor gives another depth.
  constexpr int kWidth = 70, kHeight = 5;
  Random random(13);
  const auto between = [&](std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
  };
  for (std::uint32_t id = 0; id < 100; ++id) {
    const std::int32_t top = between(-kGuardSub, -kGuardSub / 2), far = between(kGuardSub / 2, kGuardSub);
    ScreenTriangle t{{-far, far, between(-far, far)},
                     {top, id % 2 == 0 ? top : top + between(0, 1000), kGuardSub},
                     {},
                     id};
    for (auto& z : t.z) z = kDepthHead + static_cast<std::uint32_t>(random.below(kDepthRange + 1ull));
    for (auto* field : {t.x_sub, t.y_sub}) std::rotate(field, field + id % 3, field + 3);
    expect_oracle(std::span(&t, 1), kWidth, kHeight, std::to_string(id));
  }
}

TEST_P(EveryBackend, DrawsEdgesThatAreAlmostHorizontal) {
  // About as flat as 1 in 4096, where scanline turns to another way, and flatter.
  Random random(5);
  std::vector<ScreenTriangle> triangles;
  for (std::uint32_t id = 0; id < 400; ++id) {
    const auto between = [&](std::int32_t low, std::int32_t high) {
      return low + static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(high - low + 1)));
    };
    const std::int32_t x = between(-2000, 2000), y = between(0, 70 * kSub), dy = between(1, 600);
    const std::int32_t dx = std::min(between(4090, 4102) * dy, kGuardSub);
    triangles.push_back({{x, x + dx, between(0, 100 * kSub)},
                         {y, y + (id % 2 == 0 ? dy : -dy), y + between(-900, 900)},
                         {kDepthHead + id * 1000, kDepthHead + 90'000, kDepthHead + 400'000 - id * 1000},
                         id});
    if (id % 3 == 0)
      for (auto& x_sub : triangles.back().x_sub) x_sub = 90 * kSub - x_sub;
  }
  for (auto& t : triangles)
    for (auto& x_sub : t.x_sub) x_sub = std::clamp(x_sub, -kGuardSub, kGuardSub);
  expect_oracle(triangles, 90, 70, "almost horizontal");
}

TEST_P(EveryBackend, DrawsNothingButBackgroundWithoutTriangles) {
  expect_oracle({}, 70, 70, "no triangles");
}

TEST_P(EveryBackend, KeepsTheEarlierTriangleAtATie) {
  const ScreenTriangle first{{0, 40 * 256, 3 * 256}, {0, 0, 40 * 256}, {5000, 5000, 5000}, 1};
  ScreenTriangle second = first;
  second.payload = 2;
  const ScreenTriangle both[] = {first, second};
  Framebuffer frame(32, 32);
  for (const auto& execution : testing::executions()) {
    backend_->draw(both, frame.view(), 0, execution);
    EXPECT_EQ(frame.payload_row(0)[3], 1u) << testing::describe(execution);
  }
}

// Small ones may lie in other lists than large ones, whose blocks end somewhere.
TEST_P(EveryBackend, KeepsTheEarlierOfASmallAndALargeTriangleAtATie) {
  const auto right_angled = [](int at_px, int side_px, std::uint32_t z, std::uint32_t payload) {
    const std::int32_t begin = at_px * kSub, end = (at_px + side_px) * kSub;
    return ScreenTriangle{{begin, end, begin}, {begin, begin, end}, {z, z, z}, payload};
  };
  for (std::uint32_t before = 1; before <= 70; ++before) {
    std::vector<ScreenTriangle> triangles;
    std::uint32_t z = kDepthHead + 1000;
    const auto add_large = [&](int at_px) { triangles.push_back(right_angled(at_px, 80, z, 1)); };
    const auto add_small = [&](int at_px) { triangles.push_back(right_angled(at_px, 3, z, 2)); };
    for (std::uint32_t i = 0; i < before; ++i, z -= 10) add_large(0);
    z += 10;
    add_small(2);  // behind the last large one
    z -= 10;
    add_small(6);  // before the next
    add_large(6);
    expect_oracle(triangles, 20, 20, "after " + std::to_string(before) + " large ones");
  }
}

// So many that parts of different lengths are given to threads.
TEST_P(EveryBackend, DrawsTheSameOnThreadsThatShareManyTriangles) {
  const int side = 64;
  std::vector<ScreenTriangle> triangles(1'000'000);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto n = static_cast<std::uint32_t>(i);
    const std::int32_t px = i < triangles.size() / 2 ? 1 : 8;
    const auto x = static_cast<std::int32_t>(n * 2654435761u >> 18),
               y = static_cast<std::int32_t>(n * 40503u >> 18);
    const std::uint32_t z = kDepthHead + (n * 2246822519u >> 12);
    triangles[i] = {{x, x + px * kSub, x}, {y, y, y + px * kSub}, {z, z, z}, n};
  }
  const auto drawn = [&](int threads) {
    Framebuffer frame(side, side);
    Execution execution;
    execution.threads = threads;
    backend_->draw(triangles, frame.view(), kBackground, execution);
    return frame;
  };
  const Framebuffer alone = drawn(1);
  for (const int threads : {2, 3})
    testing::expect_same(alone, drawn(threads), std::to_string(threads) + " threads");
}

TEST_P(EveryBackend, DrawsTheSameHoweverTheVerticesAreRotatedOrWound) {
  for (const auto family : testing::kFamilies) {
    const auto triangles = adversarial(family, 60, 90, 70, 21);
    Framebuffer expected(90, 70), actual(90, 70);
    backend_->draw(triangles, expected.view(), kBackground, {});
    for (const auto order : {std::array{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}}) {
      auto turned = triangles;
      for (std::size_t i = 0; i < turned.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const auto from = static_cast<std::size_t>(order[k]);
          turned[i].x_sub[k] = triangles[i].x_sub[from];
          turned[i].y_sub[k] = triangles[i].y_sub[from];
          turned[i].z[k] = triangles[i].z[from];
        }
      backend_->draw(turned, actual.view(), kBackground, {});
      testing::expect_same(expected, actual, std::string(family));
    }
  }
}

TEST_P(EveryBackend, WritesEveryPixelOfACallersFrameAndNothingBesideIt) {
  constexpr int kWidth = 75, kHeight = 66;
  constexpr std::uint32_t kCanary = 0xDEADBEEF;
  const auto triangles = adversarial("subpixel", 50, kWidth, kHeight, 9);
  const Framebuffer expected = oracle(triangles, kWidth, kHeight);
  // Odd strides and starts defeat aligned stores; a multiple of four invites them.
  for (const auto& [stride, offset] :
       {std::pair{kWidth, 0}, {kWidth + 2, 1}, {kWidth + 5, 0}, {kWidth + 5, 3}}) {
    for (const auto& execution : testing::executions()) {
      const auto size = static_cast<std::size_t>(stride * (kHeight + 2) + 8);
      std::vector<std::uint32_t> depth(size, kCanary), payload(size, kCanary);
      const std::ptrdiff_t start = stride + offset;
      backend_->draw(triangles, {depth.data() + start, payload.data() + start, kWidth, kHeight, stride},
                     kBackground, execution);
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(size); ++i) {
        const std::ptrdiff_t x = (i - start) % stride, y = (i - start) / stride;
        const bool in_frame = i >= start && x < kWidth && y < kHeight;
        const auto at = static_cast<std::size_t>(i);
        ASSERT_EQ(depth[at], in_frame ? expected.depth_row(static_cast<int>(y))[x] : kCanary)
            << testing::describe(execution);
        ASSERT_EQ(payload[at], in_frame ? expected.payload_row(static_cast<int>(y))[x] : kCanary)
            << testing::describe(execution);
      }
    }
  }
}

TEST_P(EveryBackend, RefusesWhatItCannotDraw) {
  Framebuffer frame(8, 8);
  const auto draw = [&](FrameView view, Execution execution) { backend_->draw({}, view, 0, execution); };
  const FrameView good = frame.view();
  const auto with = [&](auto change) {
    FrameView view = good;
    change(view);
    return view;
  };
  EXPECT_THROW(draw(good, {.threads = 0}), std::invalid_argument);
  EXPECT_THROW(draw(good, {.threads = kMaxThreads + 1}), std::invalid_argument);
  EXPECT_THROW(draw(good, {.tile_size = 48}), std::invalid_argument);
  EXPECT_THROW(draw(with([](auto& v) { v.width = 0; }), {}), std::invalid_argument);
  EXPECT_THROW(draw(with([](auto& v) { v.height = kMaxImageSide + 1; }), {}), std::invalid_argument);
  EXPECT_THROW(draw(with([](auto& v) { v.stride = 7; }), {}), std::invalid_argument);
  EXPECT_THROW(draw(with([](auto& v) { v.depth = nullptr; }), {}), std::invalid_argument);
  EXPECT_NO_THROW(draw(good, {}));
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBackend, ::testing::ValuesIn(testing::names_of(backends())),
                         [](const auto& param) { return testing::test_name(param); });

TEST(Registry, HoldsEveryFileInTheBackendsFolder) {
  std::set<std::string> files, names;
  for (const auto& entry : std::filesystem::directory_iterator(EDGEWISE_SOURCE_DIR "/src/raster/backends"))
    files.insert(entry.path().stem());
  for (const auto& b : backends()) names.emplace(b.name);
  EXPECT_TRUE(std::includes(names.begin(), names.end(), files.begin(), files.end()));
  EXPECT_EQ(names.size(), backends().size()) << "a name stands there twice";
}

TEST(Registry, SuggestsTheNearestName) {
  try {
    find_backend("scanlien");
    FAIL() << "an unknown backend was found";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'scanline'?"), std::string::npos) << error.what();
  }
}

TEST(Registry, HasTheThreeExactBackends) {
  for (const auto name : {"naive", "tiled", "scanline"}) EXPECT_EQ(find_backend(name).name, name);
}

TEST(Framebuffer, RowsAreWholeCacheLinesAndNoMultipleOfAPageApart) {
  constexpr int kLine = 16, kPage = 1024;  // px
  for (const int width : {1, 16, 17, 1008, 1009, 1024, 1025, 1920, 2048, 4096, contract::kMaxImageSide}) {
    Framebuffer frame(width, 3);
    EXPECT_GE(frame.stride(), width);
    EXPECT_LT(frame.stride(), width + 2 * kLine) << width;
    EXPECT_EQ(frame.stride() % kLine, 0) << width;
    EXPECT_NE(frame.stride() % kPage, 0) << width;
    for (const std::uint32_t* row : {frame.depth_row(1), frame.payload_row(2)})
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(row) % (kLine * sizeof(*row)), 0u) << width;
  }
}

TEST(Framebuffer, LargeOnesBeginAtAHugePageAndMoveWithTheirViews) {
  constexpr int kSmall = 64, kLarge = 1100;  // px; 4.9 MB a plane
  constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
  const auto begins_at_huge_page = [](const Framebuffer& frame) {
    return reinterpret_cast<std::uintptr_t>(frame.depth_row(0)) % kHugePage == 0 &&
           reinterpret_cast<std::uintptr_t>(frame.payload_row(0)) % kHugePage == 0;
  };
  for (const auto& [from, to] : {std::pair{kSmall, kLarge}, {kLarge, kSmall}}) {
    Framebuffer moved(from, from), frame(to, to);
    EXPECT_EQ(begins_at_huge_page(moved), from == kLarge);
    const FrameView view = moved.view();
    view.depth[view.stride * (from - 1)] = 7;
    frame = std::move(moved);  // frees what it held, which began elsewhere
    EXPECT_EQ(frame.depth_row(from - 1), view.depth + view.stride * (from - 1));
    EXPECT_EQ(*frame.depth_row(from - 1), 7u);
  }
}

TEST(Registry, NamesThoseThatFillFirst) {
  const auto filling = filling_backends();
  for (const auto& b : backends())
    EXPECT_EQ(b.fills, std::any_of(filling.begin(), filling.end(), [&](const auto& f) { return &f == &b; }))
        << b.name;
}

TEST(Framebuffer, RefusesSidesThatTheContractCannotHold) {
  for (const int side : {-1, 0, kMaxImageSide + 1, 1'000'000}) {
    EXPECT_THROW(Framebuffer(side, 4), std::invalid_argument);
    EXPECT_THROW(Framebuffer(4, side), std::invalid_argument);
  }
}

}  // namespace
}  // namespace edgewise

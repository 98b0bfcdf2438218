// The portable pixels: rasterizers that the model allows differ only where they say so.
#include "lab/portable/portable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "edgewise/builtin.h"
#include "lab/truth.h"
#include "message_of.h"
#include "support.h"

namespace edgewise::lab {
namespace {

constexpr int kWidth = 48, kHeight = 32;

PortableTriangle triangle(std::array<float, 3> x, std::array<float, 3> y, float z, std::uint32_t id) {
  return {{{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z, z, z}}, id, true, false};
}

// Covers every sample of the picture, far from its edges.
PortableTriangle wall(float z, std::uint32_t id) {
  return triangle({-100, 300, -100}, {-100, -100, 300}, z, id);
}

std::uint64_t count(const PortablePixels& found, Unstable reason) {
  return found.counts()[static_cast<std::size_t>(reason)];
}

PortablePixels judged(const std::vector<PortableTriangle>& triangles, const Conformance& model = {}) {
  return portable_pixels(triangles, kWidth, kHeight, model, 2);
}

TEST(Portable, AgreesWhereNoEdgePasses) {
  EXPECT_EQ(count(judged({}), Unstable::no), 1u * kWidth * kHeight);
  EXPECT_EQ(count(judged({wall(0.5f, 0)}), Unstable::no), 1u * kWidth * kHeight);
}

TEST(Portable, FindsSamplesThatAnEdgeMayReach) {
  // A vertical edge this far to the right of a column of samples.
  const auto with_edge = [](float beyond_px) {
    return std::vector{triangle({20.5f + beyond_px, 20.5f + beyond_px, -400}, {-300, 300, 0}, 0.5f, 0)};
  };
  constexpr float kStep = 1.0f / 256;
  EXPECT_EQ(count(judged(with_edge(0)), Unstable::tie), 1u * kHeight);
  EXPECT_EQ(count(judged(with_edge(0)), Unstable::no), 1u * kHeight * (kWidth - 1));
  EXPECT_EQ(count(judged(with_edge(0.9f * kStep)), Unstable::edge), 1u * kHeight);
  EXPECT_EQ(count(judged(with_edge(-0.9f * kStep)), Unstable::edge), 1u * kHeight);
  EXPECT_EQ(count(judged(with_edge(1.1f * kStep)), Unstable::no), 1u * kHeight * kWidth);
  EXPECT_EQ(count(judged(with_edge(-1.1f * kStep)), Unstable::no), 1u * kHeight * kWidth);
  EXPECT_EQ(count(judged(with_edge(1.1f * kStep), {.subpixel_bits = 7}), Unstable::edge), 1u * kHeight);
  EXPECT_EQ(count(judged(with_edge(1.1f * kStep), {.transform_ulps = 250}), Unstable::edge), 1u * kHeight);

  std::vector<PortableTriangle> cut = with_edge(0);
  cut[0].clipped = true;
  EXPECT_EQ(count(judged(cut), Unstable::clip), 1u * kHeight);
  cut.push_back(wall(0.25f, 1));
  EXPECT_EQ(count(judged(cut), Unstable::no), 1u * kHeight * kWidth) << "occluded";
  cut.back() = wall(0.75f, 1);
  EXPECT_EQ(count(judged(cut), Unstable::clip), 1u * kHeight);
  cut.back().id = 0;
  EXPECT_EQ(count(judged(cut), Unstable::no), 1u * kHeight * kWidth) << "both sides show triangle 0";
}

TEST(Portable, FindsDepthsThatRoundingMayReverse) {
  const auto near_gap = [](double gap, const Conformance& model) {
    return count(judged({wall(0.5f, 0), wall(static_cast<float>(0.5 + gap), 1)}, model), Unstable::depth);
  };
  const Conformance coarse{.depth = find_depth_format("d16_unorm")};
  EXPECT_EQ(near_gap(0.0, {}), 1u * kWidth * kHeight);
  EXPECT_EQ(near_gap(0x1p-23, {}), 1u * kWidth * kHeight);
  EXPECT_EQ(near_gap(0x1p-18, {}), 0u);
  EXPECT_EQ(near_gap(0x1p-17, coarse), 1u * kWidth * kHeight);
  EXPECT_EQ(near_gap(0x1p-14, coarse), 0u);
}

TEST(Portable, CountsCulledTrianglesOnlyIfRoundingMayTurnThem) {
  PortableTriangle back = wall(0.5f, 0);
  back.drawn = false;
  EXPECT_EQ(count(judged({back}), Unstable::no), 1u * kWidth * kHeight);
  // Thinner than a step.
  PortableTriangle sliver = triangle({1, 40, 40}, {8.5f, 8.5f, 8.501f}, 0.5f, 0);
  sliver.drawn = false;
  EXPECT_GE(count(judged({sliver}), Unstable::tie), 38u);
}

TEST(Portable, RejectsWhatIsOutOfRange) {
  EXPECT_EQ(message_of([] { find_depth_format("d24"); }),
            "unknown depth format 'd24'; did you mean 'd24_unorm'? (known: d16_unorm d24_unorm d32_sfloat)");
  EXPECT_NE(message_of([] { portable_pixels({}, 0, 1, {}, 1); }), "");
  EXPECT_NE(message_of([] { portable_pixels({}, 1, 1, {.subpixel_bits = 17}, 1); }), "");
  EXPECT_NE(message_of([] { portable_pixels({}, 1, 1, {.transform_ulps = -1}, 1); }), "");
}

// One rasterizer that the model allows: it moves each vertex by less than a step, in any direction, and each
// depth by less than the error of a float z / w. The visible triangles are then exact.
std::vector<std::uint32_t> drawn_by_a_witness(const std::vector<PortableTriangle>& triangles, double step_px,
                                              std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> error(-1.0, 1.0);
  // Most errors are as large as they may be, as those that reveal a mask that is too small.
  const auto moved = [&](float value, double largest) {
    const double share = error(random);
    return static_cast<float>(double{value} +
                              largest * (std::abs(share) > 0.5 ? std::copysign(0.999, share) : share));
  };
  std::vector<FloatTriangle> floats;
  for (const PortableTriangle& t : triangles) {
    FloatTriangle f{t.at, t.id};
    for (int i = 0; i < 3; ++i) {
      f.at.x_px[i] = moved(t.at.x_px[i], step_px);
      f.at.y_px[i] = moved(t.at.y_px[i], step_px);
      f.at.z01[i] = moved(t.at.z01[i], 0x1p-24);
    }
    floats.push_back(f);
  }
  auto visible = exact_visible_triangles(floats, {kWidth, kHeight}, 1).triangle;
  for (std::uint32_t& index : visible)
    if (index != kNoTriangle) index = triangles[index].id;
  return visible;
}

// Small and large triangles, some with vertices on a coarse grid, so that edges run through samples. Every
// fifth depth is that of a neighbour.
std::vector<PortableTriangle> random_triangles(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<PortableTriangle> triangles;
  const int n = static_cast<int>(random() % 30) + 2;
  for (int i = 0; i < n; ++i) {
    const double reach = std::exp(uniform(0.0, 4.0)), cx = uniform(0, kWidth), cy = uniform(0, kHeight);
    const double grid = random() % 2 == 0 ? 2.0 : 1024.0, z = uniform(0.1, 0.9);
    PortableTriangle t{{}, static_cast<std::uint32_t>(i), true, false};
    for (int k = 0; k < 3; ++k) {
      t.at.x_px[k] = static_cast<float>(std::round((cx + uniform(-reach, reach)) * grid) / grid);
      t.at.y_px[k] = static_cast<float>(std::round((cy + uniform(-reach, reach)) * grid) / grid);
      t.at.z01[k] = static_cast<float>(z + (random() % 2 == 0 ? uniform(-0.05, 0.05) : 0.0));
    }
    if (i > 0 && random() % 5 == 0) std::copy_n(triangles.back().at.z01, 3, t.at.z01);
    triangles.push_back(t);
  }
  return triangles;
}

struct Disagreement {
  std::uint64_t inside = 0, outside = 0;  // of the mask, px
};

Disagreement witnesses_disagree(int bits, const Conformance& model, int scenes) {
  Disagreement result;
  for (int seed = 0; seed < scenes; ++seed) {
    const auto triangles = random_triangles(static_cast<std::uint32_t>(seed));
    const PortablePixels mask = portable_pixels(triangles, kWidth, kHeight, model, 1);
    const double step_px = std::ldexp(1.0, -bits);
    const auto first = drawn_by_a_witness(triangles, step_px, static_cast<std::uint32_t>(2 * seed));
    const auto second = drawn_by_a_witness(triangles, step_px, static_cast<std::uint32_t>(2 * seed + 1));
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] != second[i]) ++(mask.reasons[i] == Unstable::no ? result.outside : result.inside);
  }
  return result;
}

TEST(Portable, NoTwoConformantRasterizersDifferOutsideTheMask) {
  const int scenes = testing::full_size() ? 10'000 : 300;
  for (const int bits : {4, 8}) {
    const Disagreement found = witnesses_disagree(bits, {.subpixel_bits = bits}, scenes);
    EXPECT_EQ(found.outside, 0u) << bits << " bits";
    EXPECT_GT(found.inside, 100u) << bits << " bits";
  }
}

// Otherwise the test above would pass for any mask.
TEST(Portable, WitnessesFindAMaskThatIsTooSmall) {
  EXPECT_GT(witnesses_disagree(4, {.subpixel_bits = 5}, 100).outside, 0u);
  EXPECT_GT(witnesses_disagree(8, {.subpixel_bits = 10}, 300).outside, 0u);
}

// Of meshes, our own picture too must lie within the model.
TEST(Portable, OursIsTheReferenceOfMeshes) {
  for (const std::string name : {"cube", "cubes", "torus-knot", "terrain"}) {
    const SceneRequest request{320, 180, 0.3f, 0.2};
    const Drawable drawable = find_scene(name).make(request);
    FrontendOptions options{request.width, request.height};
    const auto triangles = portable_triangles(drawable, options);
    const PortablePixels mask = portable_pixels(triangles, options.width, options.height, {}, 2);
    options.payload = Payload::id;
    Frontend frontend;
    Framebuffer ours(options.width, options.height);
    backends().front().make()->draw(frontend.run(drawable, options), ours.view(), kNoTriangle, {});

    std::vector<FloatTriangle> drawn;
    for (const PortableTriangle& t : triangles)
      if (t.drawn) drawn.push_back({t.at, t.id});
    const auto exact = exact_visible_triangles(drawn, {options.width, options.height}, 2).triangle;
    std::uint64_t differ = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const std::uint32_t id = exact[i] == kNoTriangle ? kNoTriangle : drawn[exact[i]].payload;
      const int x = static_cast<int>(i) % options.width, y = static_cast<int>(i) / options.width;
      if (id == ours.payload_row(y)[x]) continue;
      ++differ;
      EXPECT_NE(mask.reasons[i], Unstable::no) << name << ' ' << x << ' ' << y;
    }
    const double share =
        1.0 - static_cast<double>(count(mask, Unstable::no)) / static_cast<double>(exact.size());
    EXPECT_LT(share, name == "terrain" ? 0.2 : 0.05) << name;
    EXPECT_LE(differ, exact.size() / 100) << name;
  }
}

}  // namespace
}  // namespace edgewise::lab

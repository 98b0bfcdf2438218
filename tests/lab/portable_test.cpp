// The portable pixels: rasterizers that the model allows differ only where they say so.
#include "lab/portable/portable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgewise/builtin.h"
#include "lab/coverage_support.h"
#include "lab/truth/truth.h"
#include "lab/view_space.h"
#include "message_of.h"

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

TEST(Portable, FindsSamplesThatAnEdgeMayReach) {
  EXPECT_EQ(count(judged({}), Unstable::no), 1u * kWidth * kHeight);
  EXPECT_EQ(count(judged({wall(0.5f, 0)}), Unstable::no), 1u * kWidth * kHeight);
  // A vertical edge this far to the right of a column of samples.
  const auto with_edge = [](float beyond_px) {
    return std::vector{triangle({20.5f + beyond_px, 20.5f + beyond_px, -400}, {-300, 300, 0}, 0.5f, 0)};
  };
  constexpr float kStep = 1.0f / 256;
  EXPECT_EQ(count(judged(with_edge(0)), Unstable::tie), 1u * kHeight);
  EXPECT_EQ(count(judged(with_edge(0)), Unstable::no), 1u * kHeight * (kWidth - 1));
  for (const float side : {-kStep, kStep}) {
    EXPECT_EQ(count(judged(with_edge(0.9f * side)), Unstable::edge), 1u * kHeight);
    EXPECT_EQ(count(judged(with_edge(1.1f * side)), Unstable::no), 1u * kHeight * kWidth);
  }
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

TEST(Portable, PromisesNoSampleOfATriangleBeyondTheGuardBand) {
  for (const float reach_px : {1000.0f, 1001.0f}) {
    const PortableTriangle far = triangle({1.5f, 40.5f, -reach_px}, {0, 20, 0}, 0.5f, 0);
    const PortablePixels found = judged({far, wall(0.75f, 1)}, {.guard_band_px = 1000});
    EXPECT_EQ(count(found, Unstable::clip) > 100, reach_px > 1000);
  }
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
  // Depths that round to the clear value.
  EXPECT_EQ(count(judged({wall(1.0f - 0x1p-18f, 0)}, coarse), Unstable::depth), 1u * kWidth * kHeight);
  EXPECT_EQ(count(judged({wall(1.0f - 0x1p-14f, 0)}, coarse), Unstable::depth), 0u);
  EXPECT_EQ(count(judged({wall(1.0f, 0)}), Unstable::depth), 1u * kWidth * kHeight);
}

// Rounded positions may leave so little area that the depth plane is arbitrary.
TEST(Portable, DoesNotTrustTheDepthsOfSlivers) {
  PortableTriangle sliver = triangle({1, 40, 1}, {10.497f, 10.5f, 10.503f}, 0.4f, 1);
  sliver.at.z01[1] = 0.6f;
  EXPECT_GE(count(judged({wall(0.3f, 0), sliver}), Unstable::edge), 30u);
  sliver.at.z01[1] = sliver.at.z01[0];
  EXPECT_EQ(count(judged({wall(0.3f, 0), sliver}), Unstable::edge), 0u)
      << "a level plane has no slope to magnify";
}

Scene scene_of(std::vector<glm::vec3> corners, const Camera& camera) {
  return {.meshes = {{std::move(corners), {{0, 1, 2}}, {0}}}, .instances = {{}}, .camera = camera};
}

TEST(Portable, WidensTheBoundsOfVerticesThatClippingMade) {
  const auto pieces = portable_triangles(scene_of({{-1, -1, 2}, {1, -1, -8}, {-1, 1, -8}}, {.near_z = 0.5f}),
                                         {320, 180, Cull::none});
  ASSERT_FALSE(pieces.empty());
  for (const PortableTriangle& piece : pieces) {
    EXPECT_TRUE(piece.clipped);
    EXPECT_GT(piece.position_error_px, 1e-5);
    EXPECT_LT(piece.position_error_px, 0.1);
    EXPECT_GT(piece.depth_error, 1e-7);
  }
}

TEST(Portable, AllowsTheClippingOfTrianglesThatTouchTheNearOrFarPlane) {
  for (const float z : {0.0f, 0.5f, 1.0f}) {
    TriangleStream stream{320, 180, {}};
    stream.triangles.push_back({{{10, 10, z}, {300, 10, 0.5f}, {10, 170, 0.5f}}, 0});
    const auto triangles = portable_triangles(stream, {stream.width, stream.height, Cull::none});
    ASSERT_EQ(triangles.size(), 1u);
    EXPECT_EQ(triangles[0].clipped, z != 0.5f) << z;
    EXPECT_EQ(triangles[0].position_error_px > 0.0, z != 0.5f) << z;
  }
  // For w = 41, z / w is less than 1 where z is w.
  const auto triangles = portable_triangles(
      scene_of({{-9, -9, 0}, {9, -9, 9}, {-9, 9, 9}}, {.position = {0, 0, 41}, .near_z = 1, .far_z = 41}),
      {320, 180, Cull::none});
  ASSERT_EQ(triangles.size(), 1u);
  EXPECT_TRUE(triangles[0].clipped) << triangles[0].at.z01[0];
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
  EXPECT_NE(message_of([] { find_depth_format("d24"); }), "");
  EXPECT_NE(message_of([] { portable_pixels({}, 0, 1, {}, 1); }), "");
  for (const int bits : {0, 16})
    EXPECT_NE(message_of([&] { portable_pixels({}, 1, 1, {.subpixel_bits = bits}, 1); }), "");
  EXPECT_NE(message_of([] { portable_pixels({}, 1, 1, {.transform_ulps = -1}, 1); }), "");
  EXPECT_NE(message_of([] { judged({triangle({0, 0x1p21f, 0}, {0, 0, 9}, 0.5f, 0)}); }), "");
}

// A depth plane as rasterizers evaluate it, from the first sample of the image.
struct FloatPlane {
  explicit FloatPlane(const UnsnappedTriangle& t) {
    const float x1 = t.x_px[1] - t.x_px[0], y1 = t.y_px[1] - t.y_px[0], z1 = t.z01[1] - t.z01[0];
    const float x2 = t.x_px[2] - t.x_px[0], y2 = t.y_px[2] - t.y_px[0], z2 = t.z01[2] - t.z01[0];
    const float scale = 1.0f / (x1 * y2 - y1 * x2);
    if (!std::isfinite(scale)) return;
    zx = (z1 * y2 - z2 * y1) * scale;
    zy = (z2 * x1 - z1 * x2) * scale;
    z = t.z01[0] - zx * (t.x_px[0] - 0.5f) - zy * (t.y_px[0] - 0.5f);
  }
  float at(int x, int y) const { return z + zy * static_cast<float>(y) + zx * static_cast<float>(x); }
  float zx = 0, zy = 0, z = 0;
};

// One rasterizer that the model allows: it moves each vertex by less than a step in any direction and each
// depth by less than the error of a float z / w, evaluates depth planes in floats, rounds to the format, and
// clears to 1. Of float depth buffers, every second one is reversed.
std::vector<std::uint32_t> drawn_by_a_witness(const std::vector<PortableTriangle>& triangles, double step_px,
                                              const DepthFormat& format, std::uint64_t seed) {
  Random random(seed);
  // Most errors have the largest allowed size: these reveal a mask that is too small.
  const auto moved = [&](float value, double largest) {
    const double share = random.uniform(-1.0f, 1.0f);
    return static_cast<float>(double{value} +
                              largest * (std::abs(share) > 0.5 ? std::copysign(0.999, share) : share));
  };
  const bool reversed = format.name == "d32_sfloat" && seed % 2 == 1;
  std::vector<FloatTriangle> floats;
  for (const PortableTriangle& t : triangles) {
    FloatTriangle f{t.at, t.id};
    for (int i = 0; i < 3; ++i) {
      f.at.x_px[i] = moved(t.at.x_px[i], step_px);
      f.at.y_px[i] = moved(t.at.y_px[i], step_px);
      f.at.z01[i] = moved(t.at.z01[i], 0x1p-24);
      if (reversed) f.at.z01[i] = 1.0f - f.at.z01[i];
    }
    floats.push_back(f);
  }
  std::vector<double> depth(std::size_t{kWidth} * kHeight, reversed ? 0.0 : 1.0);
  std::vector<std::uint32_t> visible(depth.size(), kNoTriangle);
  for (const Run& run : covered_runs(floats, {kWidth, kHeight}, 1)) {
    const FloatPlane plane(floats[run.triangle].at);
    for (int x = run.x0; x < run.x1; ++x) {
      const double clamped = std::clamp(double{plane.at(x, run.y)}, 0.0, 1.0);
      const double z = reversed ? -clamped : std::round(clamped / format.step) * format.step;
      const auto pixel = static_cast<std::size_t>(run.y) * kWidth + static_cast<std::size_t>(x);
      if (z < depth[pixel]) depth[pixel] = z, visible[pixel] = floats[run.triangle].payload;
    }
  }
  return visible;
}

// Small and large triangles, some with vertices on or beside pixel centres and corners. Slopes are small, and
// every fifth depth is that of a neighbour.
std::vector<PortableTriangle> random_triangles(std::uint64_t seed) {
  Random random(seed);
  constexpr std::string_view kFamilies[] = {"anywhere", "small", "near-centres", "near-lattice"};
  const auto family = kFamilies[seed % std::size(kFamilies)];
  const int count = 2 + static_cast<int>(random.below(30));
  std::vector<PortableTriangle> triangles;
  for (const FloatTriangle& t : testing::hard_floats(family, count, {kWidth, kHeight}, seed)) {
    const auto id = static_cast<std::uint32_t>(triangles.size());
    PortableTriangle& made = triangles.emplace_back(PortableTriangle{t.at, id, true, false});
    for (float& z : made.at.z01) z = 0.1f + 0.7f * t.at.z01[0] + 0.1f * z;
    if (random.below(8) == 0) std::fill_n(made.at.z01, 3, 1.0f - random.uniform(0.0f, 0x1p-22f));
    if (id > 0 && random.below(5) == 0) std::copy_n(triangles[id - 1].at.z01, 3, made.at.z01);
  }
  return triangles;
}

struct Disagreement {
  std::uint64_t inside = 0, outside = 0;  // of the mask, px
};

Disagreement witnesses_disagree(int bits, const Conformance& model, std::uint64_t scenes) {
  Disagreement result;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const auto triangles = random_triangles(seed);
    const PortablePixels mask = portable_pixels(triangles, kWidth, kHeight, model, 1);
    const double step_px = std::ldexp(1.0, -bits);
    const auto first = drawn_by_a_witness(triangles, step_px, model.depth, 2 * seed);
    const auto second = drawn_by_a_witness(triangles, step_px, model.depth, 2 * seed + 1);
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] != second[i]) ++(mask.reasons[i] == Unstable::no ? result.outside : result.inside);
  }
  return result;
}

TEST(Portable, NoTwoConformantRasterizersDifferOutsideTheMask) {
  const std::uint64_t scenes = testing::full_size() ? 10'000 : 300;
  for (const int bits : {4, 8, 12})
    for (const DepthFormat& format : depth_formats()) {
      const Disagreement found = witnesses_disagree(bits, {.subpixel_bits = bits, .depth = format}, scenes);
      EXPECT_EQ(found.outside, 0u) << bits << " bits, " << format.name;
      EXPECT_GT(found.inside, 100u) << bits << " bits, " << format.name;
    }
}

// Otherwise the test above would pass for any mask.
TEST(Portable, WitnessesFindAMaskThatIsTooSmall) {
  EXPECT_GT(witnesses_disagree(4, {.subpixel_bits = 5}, 100).outside, 0u);
  EXPECT_GT(witnesses_disagree(6, {.subpixel_bits = 8}, 300).outside, 0u);
}

class PortableBits : public ::testing::TestWithParam<int> {};

// Of meshes, our own picture too must lie within the model.
TEST_P(PortableBits, OursIsTheReferenceOfMeshes) {
  // Far from the mesh's origin, floats give distances and depths of few digits.
  constexpr std::pair<const char*, float> kScenes[] = {
      {"cube", 0}, {"cubes", 0}, {"cubes", 1000}, {"torus-knot", 0}, {"terrain", 0}};
  for (const auto& [name, shift] : kScenes) {
    const SceneRequest request{320, 180, 0.3f, 0.2};
    Scene scene = std::get<Scene>(find_scene(name).make(request));
    if (shift != 0) {
      scene = in_view_space(scene, {request.width, request.height}).scene;
      for (glm::vec3& p : scene.meshes.front().positions) p += shift;
      scene.camera.position += shift;
    }
    const Drawable drawable = scene;
    FrontendOptions options{.width = request.width, .height = request.height, .subpixel_bits = GetParam()};
    const auto triangles = portable_triangles(drawable, options);
    const PortablePixels mask =
        portable_pixels(triangles, options.width, options.height, {.subpixel_bits = GetParam()}, 2);
    options.payload = Payload::id;
    Frontend frontend;
    Framebuffer ours(options.width, options.height);
    backends().front().make()->draw(frontend.run(drawable, options), ours.view(), {kNoTriangle});

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
    EXPECT_LT(share, std::string_view(name) == "terrain" ? 0.2 : 0.05) << name;
    EXPECT_LE(differ, exact.size() / 100) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Subpixel, PortableBits, ::testing::Values(8, 12, kMaxSubpixelBits),
                         [](const auto& p) { return std::to_string(p.param); });

}  // namespace
}  // namespace edgewise::lab

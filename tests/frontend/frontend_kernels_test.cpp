// The front end's kernels emit the same triangles on every SIMD target and thread count, and the same as the
// code for one triangle at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "frontend/fixed.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"
#include "lab/cases/random_cases.h"
#include "message_of.h"
#include "support.h"

namespace edgewise {
namespace {

using testing::expect_same_triangles;
using testing::run;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// Of a family of random cases, one with triangles for several threads that are dropped, cut and culled for
// every reason; NaN and infinity among the reasons or not.
Drawable random_case(std::string_view family, bool spoilt) {
  const auto families = randomized::scene_families();
  const auto found = std::ranges::find(families, family, &randomized::SceneFamily::name);
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    Random random(seed);
    Drawable drawable = found->make(random, 640, 480);
    const FrontendStats s = run(drawable, {.width = 640, .height = 480}).stats;
    if (s.triangles > kWorthThreads && (s.not_finite > 0) == spoilt && s.emitted > 0 &&
        std::min({s.outside, s.clipped_near, s.clipped_far, s.clipped_guard, s.culled, s.zero_area}) > 0)
      return drawable;
  }
  throw std::logic_error("no such case");
}
Scene random_scene(bool spoilt) {
  return std::get<Scene>(random_case("soup", spoilt));
}
TriangleStream random_triangles() {
  return std::get<TriangleStream>(random_case("stream", true));
}

// keep_unsnapped makes the front end process one triangle at a time, and keep triangles without area.
std::vector<ScreenTriangle> one_by_one(const Drawable& drawable, FrontendOptions options) {
  options.keep_unsnapped = true;
  auto triangles = run(drawable, options).triangles;
  std::erase_if(triangles, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
  return triangles;
}

void expect_within_the_contract(std::span<const ScreenTriangle> triangles, int subpixel_bits) {
  for (const ScreenTriangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(std::max(std::abs(t.x_q15[k]), std::abs(t.y_q15[k])), contract::kGuard_q15);
      ASSERT_EQ((t.x_q15[k] | t.y_q15[k]) % (1 << (contract::kFineBits - subpixel_bits)), 0);
      ASSERT_GE(t.z[k], contract::kDepthHead);
      ASSERT_LE(t.z[k], contract::kDepthHead + contract::kDepthRange);
    }
}

void expect_alike(const Drawable& drawable, const FrontendOptions& options) {
  const auto expected = one_by_one(drawable, options);
  expect_within_the_contract(expected, options.subpixel_bits);
  const FrontendStats stats = run(drawable, options, {.target = SimdTarget::scalar}).stats;
  EXPECT_GT(stats.emitted, 0u);
  const auto targets = supported_targets();
  for (const SimdTarget target : testing::kRacesOnly ? targets.last(1) : targets)
    for (const int threads : {1, 2, 5}) {
      if (testing::kRacesOnly && threads == 1) continue;
      const auto found = run(drawable, options, {.threads = threads, .target = target});
      const std::string what = std::string(name_of(target)) + ", " + std::to_string(threads) + " threads";
      expect_same_triangles(expected, found.triangles, what);
      EXPECT_EQ(std::memcmp(&stats, &found.stats, sizeof stats), 0) << what;
    }
}

void expect_all_alike(const Drawable& drawable, FrontendOptions options) {
  for (const int bits : {8, 4, 12, 15}) {
    options.subpixel_bits = bits;
    expect_alike(drawable, options);
  }
}

TEST(FrontendKernels, TrianglesAreTheSameOnEveryTargetAndThreadCount) {
  for (const Drawable& drawable :
       {Drawable(random_scene(false)), Drawable(random_scene(true)), Drawable(random_triangles())})
    for (const Cull cull : {Cull::none, Cull::back, Cull::front})
      for (const Payload payload : {Payload::colour, Payload::id})
        expect_all_alike(drawable, {.width = 640, .height = 480, .cull = cull, .payload = payload});
  expect_all_alike(random_scene(true), {.width = 300, .height = 200, .shade = false});
}

TEST(FrontendKernels, MeshesSeenByMatricesAreTheSameOnEveryTargetAndThreadCount) {
  const CameraMatrices camera = matrices_of(random_scene(false).camera, 1.5);
  glm::dmat4 oblique = camera.projection;
  oblique[0].z = 0.3, oblique[3].z = -0.5;
  for (const CameraMatrices& matrices :
       {CameraMatrices{camera.view, perspective_projection(1, 1.5, 1e-2, double{kInf})},
        CameraMatrices{camera.view, orthographic_projection(-40, 30, -20, 30, -100, 100)},
        CameraMatrices{camera.view, oblique},
        CameraMatrices{glm::dmat4(1.0), camera.projection * camera.view}})
    for (const bool spoilt : {false, true}) {
      Scene scene = random_scene(spoilt);
      scene.matrices = matrices;
      expect_all_alike(scene, {.width = 300, .height = 200, .cull = Cull::back});
    }
}

TriangleStream in_double(const TriangleStream& stream) {
  TriangleStream exact{stream.width, stream.height, {}};
  for (const StreamTriangle& t : stream.triangles)
    exact.exact.push_back(
        {{glm::dvec3(t.vertex[0]), glm::dvec3(t.vertex[1]), glm::dvec3(t.vertex[2])}, t.colour});
  return exact;
}

TEST(FrontendKernels, StreamsInDoubleAreTheSameOnEveryTargetAndThreadCount) {
  const TriangleStream stream = random_triangles(), exact = in_double(stream);
  const FrontendOptions options{.width = 640, .height = 480, .cull = Cull::none};
  expect_all_alike(exact, options);
  FrontendOptions fine = options;
  fine.subpixel_bits = 15;
  expect_same_triangles(run(stream, fine).triangles, run(exact, fine).triangles, "floats in double");
}

// A triangle as large as the guard band, with an area of 16 sub-units²: the two products of its area round to
// the same double. Vertices 1 and 2 are multiples of 32 sub-units. Vertex 0 is the nearest point beside their
// line.
std::optional<StreamTriangle> thinnest_triangle(Random& random) {
  constexpr std::int64_t kCoarse = 32, kMost = contract::kGuard_q15 / kCoarse;  // floats hold multiples
  const auto below = [&](std::int64_t n) {
    return static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(n)));
  };
  const std::int64_t x1 = -kMost / 2 - below(kMost / 2), y1 = -kMost / 2 - below(kMost / 2);
  const std::int64_t x2 = below(4096) - x1 - 4096, y2 = below(4096) - y1 - 4096;
  const std::int64_t a = x2 - x1, b = y2 - y1;
  // a y - b x = 1, by Euclid's algorithm.
  std::int64_t rest = a, divisor = b, y = 1, next = 0;
  while (divisor != 0) {
    const std::int64_t quotient = rest / divisor;
    rest = std::exchange(divisor, rest - quotient * divisor), y = std::exchange(next, y - quotient * next);
  }
  if (rest != 1) return std::nullopt;
  const std::int64_t x = (a * y - 1) / b, steps = (-kCoarse * x1 - x) / a;
  const std::int64_t x0 = kCoarse * x1 + x + steps * a, y0 = kCoarse * y1 + y + steps * b;
  if (std::max(std::abs(x0), std::abs(y0)) >= 1 << 24) return std::nullopt;
  const auto vertex = [&](std::int64_t vx, std::int64_t vy) {
    return glm::vec3(std::ldexp(static_cast<float>(vx), -contract::kFineBits),
                     std::ldexp(static_cast<float>(vy), -contract::kFineBits), 0.5f);
  };
  return StreamTriangle{
      {vertex(x0, y0), vertex(kCoarse * x1, kCoarse * y1), vertex(kCoarse * x2, kCoarse * y2)}, 0};
}

TEST(FrontendKernels, SignsOfTheSmallestAreasAreExact) {
  Random random(9);
  TriangleStream stream{640, 480, {}};
  while (stream.triangles.size() < 1000)
    if (auto t = thinnest_triangle(random)) {
      if (stream.triangles.size() % 2 == 0) std::swap(t->vertex[1], t->vertex[2]);
      stream.triangles.push_back(*t);
    }
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    const FrontendOptions options{.width = 640, .height = 480, .cull = cull, .subpixel_bits = 15};
    expect_alike(stream, options);
    EXPECT_EQ(run(stream, options).triangles.size(), cull == Cull::none ? 1000u : 500u);
  }
}

// Of positions that floats don't hold.
TEST(FrontendKernels, StreamsInDoubleAreRoundedOnce) {
  Random random(5);
  for (const int bits : {4, 8, 12, 15}) {
    TriangleStream stream{640, 480, {}};
    for (int i = 0; i < 1000; ++i) {
      auto& t = stream.exact.emplace_back();
      for (auto& v : t.vertex)
        v = {512 + 100 * static_cast<double>(random.next() >> 11) * 0x1p-53, random.uniform(0, 480), 0.5};
    }
    const auto triangles =
        run(stream,
            {.width = 640, .height = 480, .cull = Cull::none, .payload = Payload::id, .subpixel_bits = bits})
            .triangles;
    EXPECT_GT(triangles.size(), 900u);
    for (const ScreenTriangle& t : triangles)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(t.x_q15[k],
                  std::nearbyint(std::ldexp(stream.exact[t.payload].vertex[k].x, bits)) * (1 << (15 - bits)));
  }
}

// A float in [0, 1] in contract units, rounded half to even. A long double holds the product.
std::uint32_t exact_depth(float z01) {
  static_assert(std::numeric_limits<long double>::digits >= 64);
  const auto product = static_cast<long double>(z01) * contract::kDepthRange;
  return contract::kDepthHead + static_cast<std::uint32_t>(std::nearbyint(product));
}

// With every SIMD target's kernel, and with quantize_depth(). At full size all floats in [0, 1]; otherwise
// every 1009th, the ends of every binade, and all ties.
TEST(FrontendKernels, DepthsAreRoundedHalfToEven) {
  const FrontendOptions options{.width = 64, .height = 64, .cull = Cull::none};
  const StreamTriangle triangle{{{0, 0, 0}, {50, 0, 0}, {0, 50, 0}}, 0};
  TriangleStream stream{64, 64, std::vector(kChunkTriangles, triangle)};
  TriangleBuffers made;
  made.reserve(ChunkOutput::room_for(kChunkTriangles), false);
  std::vector<std::uint32_t> expected;
  const auto check = [&] {
    for (const SimdTarget target : supported_targets()) {
      ChunkOutput out;
      out.write_to(made, 0);
      stream_kernel(target)({options, stream}, 0, kChunkTriangles, out);
      ASSERT_EQ(out.count, kChunkTriangles);
      for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_EQ(out.triangles[i / 3].z[i % 3], expected[i])
            << name_of(target) << ": " << stream.triangles[i / 3].vertex[i % 3].z;
    }
    expected.clear();
  };
  const auto add = [&](float z01) {
    stream.triangles[expected.size() / 3].vertex[expected.size() % 3].z = z01;
    expected.push_back(exact_depth(z01));
    ASSERT_EQ(quantize_depth(z01), expected.back()) << "one by one: " << z01;
    if (expected.size() == 3 * kChunkTriangles) check();
  };
  constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.0f);
  for (const float tie : {0.125f, 0.375f, 0.625f, 0.875f}) add(tie);
  for (std::uint32_t binade = 0; binade <= kOne; binade += 1u << 23)
    for (const std::uint32_t bits : {binade - 1, binade, binade + 1})
      if (bits <= kOne) add(std::bit_cast<float>(bits));
  const std::uint32_t step = testing::full_size() ? 1 : 1009;
  for (std::uint32_t bits = 0; bits <= kOne && !HasFatalFailure(); bits += step)
    add(std::bit_cast<float>(bits));
  check();
}

// Meshes with sizes around those of vectors, chunks and ranges. Some are empty, out of view, without a finite
// vertex, or have triangles that must be clipped.
Scene scene_of_many_meshes() {
  Random random(4);
  Scene scene;
  scene.camera.near_z = 1e-2f;
  const auto add = [&](std::size_t triangles) {
    Mesh& mesh = scene.meshes.emplace_back();
    for (std::size_t i = 0; i < triangles / 2 + 3; ++i)
      mesh.positions.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (std::size_t i = 0; i < triangles; ++i) {
      const auto vertex = [&] { return static_cast<unsigned>(random.below(mesh.positions.size())); };
      mesh.triangles.emplace_back(vertex(), vertex(), vertex());
      mesh.colours.push_back(static_cast<std::uint32_t>(random.below(1ull << 32)));
    }
    if (scene.meshes.size() % 16 == 0) mesh.positions.assign(mesh.positions.size(), glm::vec3(kNan));
    Instance instance{.mesh = scene.meshes.size() - 1};
    instance.angle = random.uniform(0, 6);
    instance.translation = {random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(-9, 1)};
    scene.instances.push_back(instance);
  };
  for (const std::size_t triangles :
       {0u, 1u, 12u, 2047u, 2048u, 2049u, 5000u, 0u, 8191u, 8192u, 30'000u, 100'000u, 1u}) {
    for (int i = 0; i < 50; ++i) add(random.below(40));
    add(triangles);
  }
  for (int i = 0; i < 2000; ++i) add(1);
  return scene;
}

TEST(FrontendKernels, ManyMeshesAreTheSameOnEveryTargetAndThreadCount) {
  const Scene scene = scene_of_many_meshes();
  const auto stats = run(scene, {.width = 300, .height = 200}).stats;
  for (const auto count : {stats.meshes_culled, stats.not_finite, stats.clipped_near, stats.culled})
    EXPECT_GT(count, 0u);
  expect_all_alike(scene, {.width = 300, .height = 200});
  expect_all_alike(scene, {.width = 300, .height = 200, .shade = false});
  expect_all_alike(scene, {.width = 300, .height = 200, .cull = Cull::none, .payload = Payload::id});
}

TEST(FrontendKernels, ManyMeshesGiveTheSameAsEachAlone) {
  const Scene scene = scene_of_many_meshes();
  const FrontendOptions options{.width = 300, .height = 200};
  std::vector<ScreenTriangle> expected;
  FrontendStats sum;
  for (const Instance& instance : scene.instances) {
    Scene alone = testing::scene_of(scene.meshes[instance.mesh]);
    alone.camera = scene.camera, alone.to_light = scene.to_light;
    alone.instances[0] = instance, alone.instances[0].mesh = 0;
    const auto [triangles, stats] = run(alone, options, {.threads = 2});
    expected.insert(expected.end(), triangles.begin(), triangles.end());
    sum += stats;
  }
  const auto together = run(scene, options, {.threads = 2});
  expect_same_triangles(expected, together.triangles, "together");
  EXPECT_EQ(std::memcmp(&sum, &together.stats, sizeof sum), 0);
}

// Coordinates on and next to every plane of the view volume for the given w, and special values.
std::vector<float> borders(float w, float side_px) {
  std::vector<float> values{0.0f, -0.0f, 1e-45f, 3e38f, -3e38f, kNan, kInf, -kInf};
  for (const float border : {w, side_px * w, 16384.0f * w, -16384.0f * w, 0.5f * side_px * w})
    for (const float value : {border, std::nextafter(border, kInf), std::nextafter(border, -kInf)})
      values.push_back(value);
  return values;
}

// outside_of(), with the products by the image's sides rounded to float as in the kernels.
std::uint32_t flags_in_float(glm::vec3 v, const ViewVolume& view) {
  std::uint32_t flags = outside_of(as_clip_vertex(v), view);
  if ((flags & kNotFinite) != 0) return flags;
  flags &= ~std::uint32_t{kRight | kBottom};
  if (v.x > static_cast<float>(view.width_px) * v.z) flags |= kRight;
  if (v.y > static_cast<float>(view.height_px) * v.z) flags |= kBottom;
  return flags;
}

constexpr int kPlanesWidth = 640, kPlanesHeight = 480;

// Compares vertices on planes, of any target's kernel, with expected(task, position, transformed position).
template <typename Expected>
void expect_on_planes(float w, const ViewVolume& view, bool has_z, Expected&& expected) {
  const FrontendOptions options{.width = kPlanesWidth, .height = kPlanesHeight};
  Mesh mesh;
  for (const float x : borders(w, kPlanesWidth))
    for (const float y : borders(w, kPlanesHeight))
      for (const float z : borders(w, 2.0f)) mesh.positions.emplace_back(x, y, z);
  ScreenTransform to_screen({Camera{}, kPlanesWidth, kPlanesHeight}, glm::dmat4(1.0));
  to_screen.origin = glm::vec3(0.0f);
  to_screen.rounded = glm::mat4x3(1.0f);
  to_screen.rounded[3] = {0.0f, 0.0f, w};
  to_screen.has_z = has_z;
  if (has_z) {
    to_screen.rounded[2].z = 0.0f;
    to_screen.z = {0, 0, 1, 0}, to_screen.w = {0, 0, 0, w};
  }
  const MeshTask task{options, mesh, view, to_screen, ViewDepth(0.5, 0.9)};
  std::vector<Vertex> vertices(mesh.positions.size());
  for (const SimdTarget target : supported_targets()) {
    transform_kernel(target)(task, mesh.positions.data(), vertices.size(), vertices.data());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const glm::vec3 v = transform(to_screen, mesh.positions[i]);
      const Vertex e = expected(task, mesh.positions[i], v);
      ASSERT_EQ(vertices[i].outside, e.outside) << name_of(target) << ", w = " << w << ", " << i;
      if (!is_inside(e)) continue;
      ASSERT_EQ(std::memcmp(&vertices[i], &e, sizeof e), 0) << name_of(target) << ", " << i;
    }
  }
}

// With the depth `z`.
Vertex snapped(glm::vec3 v, std::uint32_t z, std::uint32_t outside) {
  return {snap(v.x * (1.0f / v.z)), snap(v.y * (1.0f / v.z)), z, outside};
}

TEST(FrontendKernels, VerticesOnPlanesMatchTheScalarFlags) {
  for (const float w : {1.0f, 0.7f, 0.5f, 0.9f, 0.0f, -0.0f, -1.0f, 1e-45f, 1e-38f, 3e38f, kNan, kInf})
    expect_on_planes(w, {kPlanesWidth, kPlanesHeight, 0.5, 0.9}, false,
                     [](const MeshTask& task, glm::vec3, glm::vec3 v) {
                       return snapped(v, task.depth.units(double{v.z}), flags_in_float(v, task.view));
                     });
}

// The same for a z of its own, which is the position's here.
TEST(FrontendKernels, VerticesWithZOnPlanesMatchTheScalarFlags) {
  for (const float w : {1.0f, 0.7f, 0.0f, -1.0f, 1e-38f, 3e38f})
    expect_on_planes(w, {kPlanesWidth, kPlanesHeight, 0.0, 0.0, 1.0}, true,
                     [&](const MeshTask&, glm::vec3 position, glm::vec3 v) {
                       const float z = position.z;
                       std::uint32_t outside = flags_in_float(v, {kPlanesWidth, kPlanesHeight, v.z, v.z});
                       if (outside != kNotFinite && z < 0.0f) outside |= kNear;
                       if (outside != kNotFinite && z > w) outside |= kFar;
                       if ((outside & (kMustClip | kNotFinite)) == 0 && !std::isfinite(1.0f / v.z))
                         outside |= kNear;
                       return snapped(v, round_depth(double{z} / double{w} * contract::kDepthRange), outside);
                     });
}

TEST(FrontendKernels, StreamsOnPlanesAreTheSameOnEveryTarget) {
  constexpr int kWidth = 640, kHeight = 480;
  Random random(3);
  const auto one_of = [&](float side_px) {
    const auto values = borders(1.0f, side_px);
    return values[random.below(values.size())];
  };
  TriangleStream stream{kWidth, kHeight, {}};
  for (int i = 0; i < 40'000; ++i) {
    StreamTriangle t{};
    // Half of the triangles have all vertices on one vertical or horizontal line.
    const glm::vec2 line(one_of(kWidth), one_of(kHeight));
    for (auto& v : t.vertex)
      v = {i % 4 == 0 ? line.x : one_of(kWidth), i % 4 == 1 ? line.y : one_of(kHeight), random.below(2)};
    stream.triangles.push_back(t);
  }
  expect_all_alike(stream, {.width = kWidth, .height = kHeight, .cull = Cull::none});
}

// Streams of lengths around those of a vector and a chunk: no triangle is lost, duplicated or reordered.
TEST(FrontendKernels, StreamsOfAnyLengthKeepTheOrder) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{15}, std::size_t{16}, std::size_t{17},
        kChunkTriangles - 1, kChunkTriangles, kChunkTriangles + 1, kWorthThreads - 1, kWorthThreads,
        3 * kWorthThreads + 5, std::size_t{200'005}}) {
    TriangleStream stream{100, 100, {}};
    for (std::size_t i = 0; i < count; ++i)
      stream.triangles.push_back({{{1, 1, 0.5f}, {50, 1, 0.5f}, {1, 50, 0.5f}}, 0});
    const auto found = run(stream, {.width = 100, .height = 100, .cull = Cull::none, .payload = Payload::id},
                           {.threads = 3});
    ASSERT_EQ(found.triangles.size(), count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(found.triangles[i].payload, i);
  }
}

TEST(FrontendKernels, NamesTheMissingVertexOfAMeshAmongMany) {
  Scene scene = scene_of_many_meshes();
  const auto is_invalid = [](const Mesh& mesh) { return mesh.triangles.size() == 5000; };
  Mesh& mesh = *std::find_if(scene.meshes.begin(), scene.meshes.end(), is_invalid);
  mesh.triangles[2345].z = 70'000;
  Instance& instance = scene.instances[static_cast<std::size_t>(&mesh - scene.meshes.data())];
  instance.translation = {0, 0, -5};
  for (const SimdTarget target : supported_targets())
    for (const int threads : {1, 2})
      EXPECT_EQ(message_of([&] { run(scene, {}, {.threads = threads, .target = target}); }),
                "triangle 2345 names vertex 70000 of 2503");
  instance.translation = {0, 0, 50};
  EXPECT_GT(run(scene, {}, {.threads = 2}).stats.emitted, 0u) << "meshes out of view are not checked";
  Scene without = random_scene(false);
  without.meshes[0].positions.clear();
  EXPECT_NE(message_of([&] { run(without, {}); }), "");
}

// Compares each triangle's state with the statistics and with the ids of the emitted triangles.
void expect_states_agree(const Drawable& drawable, FrontendOptions options) {
  options.payload = Payload::id;
  const auto plain = run(drawable, options);
  options.keep_states = true;
  for (const int threads : {1, 3}) {
    Frontend frontend;
    const auto triangles = frontend.run(drawable, options, {.threads = threads});
    expect_same_triangles(plain.triangles, {triangles.begin(), triangles.end()}, "with states");
    const FrontendStats& stats = frontend.stats();
    EXPECT_EQ(std::memcmp(&stats, &plain.stats, sizeof stats), 0);
    const auto states = frontend.states();
    ASSERT_EQ(states.size(), stats.triangles);
    const auto count = [&](TriangleState state) {
      return static_cast<std::uint64_t>(std::count(states.begin(), states.end(), state));
    };
    EXPECT_EQ(count(TriangleState::outside_with_mesh), stats.whole_mesh);
    EXPECT_EQ(count(TriangleState::not_finite), stats.not_finite);
    EXPECT_EQ(count(TriangleState::outside), stats.outside);
    EXPECT_EQ(count(TriangleState::not_in_front), stats.not_in_front);
    EXPECT_LE(count(TriangleState::clipped), stats.clipped);
    EXPECT_GT(count(TriangleState::clipped), 0u);
    EXPECT_EQ(count(TriangleState::culled) > 0, stats.culled > 0);
    EXPECT_LE(count(TriangleState::culled), stats.culled);
    EXPECT_LE(count(TriangleState::zero_area), stats.zero_area);
    std::vector<bool> emitted(states.size());
    for (const ScreenTriangle& t : triangles) emitted[t.payload] = true;
    for (std::size_t i = 0; i < states.size(); ++i)
      ASSERT_EQ(states[i] >= TriangleState::active, emitted[i]) << i << ": " << static_cast<int>(states[i]);
  }
}

TEST(FrontendKernels, StatesAgreeWithTheStatistics) {
  for (const bool spoilt : {false, true})
    for (const Cull cull : cull_modes()) {
      if (cull == Cull::both) continue;  // no clipped triangle would be emitted
      expect_states_agree(random_scene(spoilt), {.width = 300, .height = 200, .cull = cull});
      expect_states_agree(random_triangles(), {.width = 640, .height = 480, .cull = cull});
    }
}

TEST(FrontendKernels, KeepsNoResultsAfterThrowing) {
  const Scene good = random_scene(false);
  Scene bad_camera = good, bad_mesh = good;
  bad_camera.camera.near_z = -1;
  bad_mesh.meshes[0].triangles.back().x = 1 << 20;
  Frontend frontend;
  const FrontendOptions keep{.width = 300, .height = 200, .keep_unsnapped = true, .keep_states = true};
  const auto expect_throw = [&](const Scene& scene, FrontendOptions options) {
    EXPECT_THROW(frontend.run(scene, options), std::invalid_argument);
    EXPECT_EQ(frontend.unsnapped().size(), 0u);
    EXPECT_EQ(frontend.states().size(), 0u);
  };
  for (const Scene* bad : {&bad_camera, &bad_mesh}) {
    expect_throw(*bad, keep);
    const std::size_t count = frontend.run(good, keep).size();
    EXPECT_GT(count, 0u);
    EXPECT_EQ(frontend.unsnapped().size(), count);
    EXPECT_EQ(frontend.states().size(), frontend.stats().triangles);
    expect_throw(*bad, keep);
    expect_throw(good, {.width = 0, .keep_unsnapped = true, .keep_states = true});
  }
}

}  // namespace
}  // namespace edgewise

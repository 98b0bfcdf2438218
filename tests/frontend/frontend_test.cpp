// The front end: culling, clipping, snapping and shading.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/frontend.h"
#include "frontend/clip.h"
#include "frontend/fixed.h"
#include "lab/cases/backend_comparison.h"
#include "lab/cases/random_cases.h"
#include "support.h"

namespace edgewise {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// A mesh of unconnected triangles. The camera is at the origin, looks along -z and has a field of view of 90
// degrees.
Scene loose(const std::vector<glm::vec3>& positions) {
  Mesh mesh;
  mesh.positions = positions;
  for (unsigned i = 0; i + 2 < positions.size(); i += 3) {
    mesh.triangles.emplace_back(i, i + 1, i + 2);
    mesh.colours.push_back(rgb(200, 100, 50));
  }
  Scene scene = testing::scene_of(std::move(mesh));
  scene.camera.fov_y = 1.57079633f;
  scene.to_light = {0.0f, 0.0f, 1.0f};
  return scene;
}

// Clockwise as seen from the camera.
const std::vector<glm::vec3> kFront = {{-1, -1, -3}, {-1, 1, -3}, {1, -1, -3}};

testing::Emitted run(const Drawable& drawable,
                     const FrontendOptions& options = {.width = 100, .height = 100, .cull = Cull::none},
                     const Execution& execution = {}) {
  return testing::run(drawable, options, execution);
}

TEST(Snap, RoundsHalfToEvenAndClampsToTheGuardBand) {
  Random random(1);
  for (int bits = kMinSubpixelBits; bits <= kMaxSubpixelBits; ++bits) {
    const auto expect_snapped = [&](double px) {
      const double units = std::nearbyint(std::ldexp(std::clamp(px, -16384.0, 16384.0), bits));
      ASSERT_EQ(snap(px, bits), std::ldexp(units, contract::kFineBits - bits))
          << px << ", " << bits << " bits";
    };
    for (const double units : {0.5, 1.5, 2.5, -0.5, -1.5, 1e30, -1e30, 0.49999997})
      expect_snapped(std::ldexp(units, -bits));
    for (int i = 0; i < 100'000; ++i) {
      expect_snapped(double{random.uniform(-16400.0f, 16400.0f)});
      expect_snapped(std::ldexp(static_cast<double>(random.next() >> 11), -38) - 16384.0);
    }
  }
}

TEST(Frontend, NeighboursGetTheSameVertexOnAClippedEdge) {
  Random random(17);
  constexpr ViewVolume kView{100, 100, 0.5, 2.0};
  int cuts = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto vertex = [&] {
      const float w = random.uniform(0.1f, 3.0f), reach = 20'000.0f * w;
      return ClipVertex{random.uniform(-reach, reach), random.uniform(-reach, reach), w, w};
    };
    const ClipVertex p = vertex(), q = vertex();
    const auto plane = static_cast<std::uint16_t>(kNear << random.below(6));  // one of the six clip planes
    if ((outside_of(p, kView) & plane) == (outside_of(q, kView) & plane)) continue;
    // Neighbours traverse their shared edge in opposite directions.
    Clipper clipper, of_neighbour;
    const auto polygon = clipper.clip({p, q, vertex()}, plane, kView),
               neighbour = of_neighbour.clip({q, p, vertex()}, plane, kView);
    const auto is_shared = [&](const ClipVertex& a) {
      return a.id >= 3 && std::ranges::any_of(neighbour, [&](const ClipVertex& b) {
               return b.id >= 3 && a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
             });
    };
    ASSERT_EQ(std::ranges::count_if(polygon, is_shared), 1) << "edge " << i;
    ++cuts;
  }
  EXPECT_GT(cuts, 1000);
}

TEST(Frontend, IdsBeginAtTheFirstId) {
  constexpr std::uint32_t kFirst = 1'000'000;
  for (const auto& family : randomized::scene_families()) {
    Random random(7);
    const Drawable drawable = family.make(random, 100, 100);
    for (const bool shade : {false, true})
      for (const bool keep_states : {false, true})  // the path for single triangles
        for (const SimdTarget target : supported_targets())
          for (const int threads : {1, 3}) {
            FrontendOptions options{.width = 100, .height = 100, .cull = Cull::none, .shade = shade};
            options.keep_states = keep_states;
            const Execution execution{.threads = threads, .target = target};
            auto colours = run(drawable, options, execution).triangles;
            options.first_id = kFirst;
            testing::expect_same_triangles(colours, run(drawable, options, execution).triangles, "colours");
            options.payload = Payload::id, options.first_id = 0;
            auto expected = run(drawable, options, execution).triangles;
            ASSERT_GT(expected.size(), 8u) << family.name;
            for (ScreenTriangle& t : expected) t.payload += kFirst;
            options.first_id = kFirst;
            testing::expect_same_triangles(expected, run(drawable, options, execution).triangles,
                                           std::string(family.name));
          }
  }
}

TEST(Frontend, RefusesIdsBeyondTheLimit) {
  const StreamTriangle triangle{{{33, 33, 0}, {66, 66, 0}, {33, 66, 0}}, 0};
  FrontendOptions options{.width = 100, .height = 100, .cull = Cull::none, .payload = Payload::id};
  for (const Drawable& drawable : {Drawable(TriangleStream{100, 100, {triangle}}), Drawable(loose(kFront))}) {
    options.first_id = kMaxTriangles - 1;
    EXPECT_EQ(run(drawable, options).triangles.at(0).payload, kMaxTriangles - 1);
    ++options.first_id;
    EXPECT_THROW(run(drawable, options), std::invalid_argument);
  }
}

TEST(Frontend, ShadesByTheLightWithAMinimum) {
  Scene scene = loose(kFront);
  const auto red = [&](glm::vec3 to_light) {
    scene.to_light = to_light;
    return run(scene).triangles.at(0).payload & 255;
  };
  EXPECT_EQ(red({0, 0, 1}), 200u) << "light from the camera's side";
  EXPECT_EQ(red({0, 0, -1}), 30u) << "max(n.l, 0.15)";
  EXPECT_EQ(red({0, 3, 4}), 160u) << "n.l = 0.8 for every length";
  for (const float size : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
    auto positions = kFront;
    for (auto& p : positions) p *= size;
    Scene scaled = loose(positions);
    scaled.to_light = {0, 3, 4}, scaled.camera.near_z = 0.1f * size, scaled.camera.far_z = 100.0f * size;
    EXPECT_EQ(run(scaled).triangles.at(0).payload & 255, 160u) << size;
  }
  FrontendOptions flat{.width = 100, .height = 100, .cull = Cull::none, .shade = false};
  EXPECT_EQ(run(scene, flat).triangles.at(0).payload, rgb(200, 100, 50));
}

TEST(Frontend, DrawsATriangleNearTheLargestFloats) {
  constexpr float kFar = 3e38f;
  const TriangleStream stream{100, 100, {{{{-kFar, -kFar, 0.5f}, {kFar, -kFar, 0.5f}, {50, kFar, 0.5f}}, 7}}};
  const auto result = run(stream);
  EXPECT_EQ(lab::covered_pixels(result.triangles, 100, 100), 100u * 100u);
}

TEST(Frontend, UnsnappedTrianglesRoundToTheSnappedOnes) {
  for (const auto name : {"terrain", "small"}) {
    const Drawable drawable = find_scene(name).make({.width = 300, .height = 200, .scale = 0.01});
    Frontend frontend;
    FrontendOptions options{.width = 300, .height = 200, .cull = Cull::none, .keep_unsnapped = true};
    const auto triangles = frontend.run(drawable, options);
    const auto unsnapped = frontend.unsnapped();
    ASSERT_EQ(triangles.size(), unsnapped.size());
    EXPECT_EQ(frontend.stats().zero_area, 0u) << "triangles without area are kept";
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(snap(unsnapped[i].x_px[k]), triangles[i].x_q15[k]);
        ASSERT_EQ(snap(unsnapped[i].y_px[k]), triangles[i].y_q15[k]);
        if (std::holds_alternative<TriangleStream>(drawable))
          ASSERT_EQ(quantize_depth(unsnapped[i].z01[k]), triangles[i].z[k]);
        else  // z01 is the less accurate quotient z / w
          ASSERT_NEAR(double{unsnapped[i].z01[k]}, contract::depth01(triangles[i].z[k]), 0x1p-20);
      }
    options.keep_unsnapped = false;
    frontend.run(drawable, options);
    EXPECT_TRUE(frontend.unsnapped().empty());
  }
}

TEST(Frontend, RefusesInvalidInput) {
  const auto expect_refused = [](auto change) {
    Scene scene = loose(kFront);
    FrontendOptions options{.width = 64, .height = 64};
    change(scene, options);
    EXPECT_THROW(run(scene, options), std::invalid_argument);
  };
  expect_refused([](Scene&, FrontendOptions& o) { o.width = 0; });
  expect_refused([](Scene&, FrontendOptions& o) { o.height = 16385; });
  expect_refused([](Scene&, FrontendOptions& o) { o.subpixel_bits = kMinSubpixelBits - 1; });
  expect_refused([](Scene&, FrontendOptions& o) { o.subpixel_bits = kMaxSubpixelBits + 1; });
  expect_refused([](Scene& s, FrontendOptions&) { s.camera.fov_y = 0.0f; });
  expect_refused([](Scene& s, FrontendOptions&) { s.camera.near_z = 0.0f; });
  expect_refused([](Scene& s, FrontendOptions&) { s.camera.far_z = s.camera.near_z; });
  expect_refused([](Scene& s, FrontendOptions&) { s.camera.position.x = kNan; });
  expect_refused([](Scene& s, FrontendOptions&) { s.instances[0].mesh = 1; });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].triangles[0].z = 3; });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].colours.clear(); });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].flags.resize(2); });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].flags = {kSameFace}; });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].normals.resize(2); });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].clusters.resize(2); });
  expect_refused([](Scene& s, FrontendOptions&) { s.meshes[0].origin.y = kNan; });
  for (const auto& [column, row, value] :
       {std::tuple{0, 1, kInf}, {3, 2, kNan}, {0, 3, 0.1f}, {3, 3, 2.0f}}) {  // not finite, or not affine
    Scene scene = loose(kFront);
    glm::dmat4& matrix = scene.instances[0].matrix.emplace(1.0);
    matrix[column][row] = double{value};
    EXPECT_THROW(run(scene), std::invalid_argument) << column << ", " << row;
  }
  for (const int threads : {0, -1, kMaxThreads + 1})
    EXPECT_THROW(run(loose(kFront), {}, {.threads = threads}), std::invalid_argument);
}

// ---- Clipped polygons are split into triangles of one winding if such a split exists.

using Polygon = std::vector<Vertex>;

Polygon polygon_of(std::initializer_list<std::pair<int, int>> positions) {
  Polygon polygon;
  for (const auto& [x, y] : positions) polygon.push_back({x, y, 0, 0});
  return polygon;
}

// Twice the area.
std::int64_t area(const Polygon& polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += std::int64_t{p.x_q15} * q.y_q15 - std::int64_t{p.y_q15} * q.x_q15;
  }
  return sum;
}

TEST(Pieces, HaveThePolygonsAreaAndWinding) {
  const struct {
    Polygon forward;
    bool has_split = true;
  } cases[] = {
      {polygon_of({{0, 0}, {20, -10}, {40, 0}, {40, 20}, {20, 30}, {0, 20}})},
      // Vertex 1 is concave, so a fan from vertex 0 has a triangle of the opposite winding.
      {polygon_of({{0, 0}, {50, 1}, {100, 0}, {50, 90}})},
      {polygon_of({{0, 0}, {1, 1}, {100, 0}, {100, 90}, {0, 90}})},
      {polygon_of({{0, 0}, {30, 1}, {100, 0}, {99, 40}, {100, 90}, {50, 89}, {0, 90}, {1, 50}, {2, 49}})},
      {polygon_of({{0, 0}, {100, 10}, {100, 0}, {0, 9}}), false}};  // crosses itself
  for (const auto& [forward, has_split] : cases)
    for (Polygon polygon : {forward, Polygon(forward.rbegin(), forward.rend())})
      for (std::size_t turn = 0; turn < polygon.size(); ++turn) {
        const Pieces pieces = split(polygon);
        ASSERT_EQ(pieces.count, polygon.size() - 2);
        std::int64_t sum = 0, sizes = 0;
        for (std::size_t i = 0; i < pieces.count; ++i) {
          const auto [a, b, c] = pieces.corners[i];
          const std::int64_t one = area({polygon.at(a), polygon.at(b), polygon.at(c)});
          sum += one, sizes += std::abs(one);
        }
        EXPECT_EQ(sum, area(polygon));
        EXPECT_TRUE(!has_split || sizes == std::abs(sum)) << "turn " << turn;
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      }
}

}  // namespace
}  // namespace edgewise

// Clipping of one, two and three vertices by each of the six planes and by several of them.
//
// The planes are near, far and the four sides of the guard band. The image's sides clip nothing. The tests
// assert:
// - If the new vertices lie on the grid, nothing is rounded: every pixel matches the exact polygon.
// - Otherwise every sample farther than 1/64 px from an edge matches, and one triangle hits no sample twice.
// - Neighbours that share clipped edges and fill the image hit every pixel once, without exception.
// - Triangles beyond a plane draw nothing.
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "conformance/pipeline.h"
#include "core/random.h"
#include "lab/clipping/truth.h"

namespace edgewise::conformance {
namespace {

// Fewer would move edges by more than lab::kHairlinePx.
constexpr int kClippedBits[] = {8, kMaxSubpixelBits};

// In rationals. Every corner must lie on the grid of 8 bits.
std::vector<SubPosition> exact_polygon(const Triangle& t, const Plane& plane) {
  std::vector<SubPosition> polygon;
  const auto add = [&](const mpq_class& x, const mpq_class& y) {
    const mpq_class sx(x * 256), sy(y * 256);
    EXPECT_TRUE(sx.get_den() == 1 && sy.get_den() == 1);
    polygon.push_back({sx.get_num().get_si() * (kPixel / 256), sy.get_num().get_si() * (kPixel / 256)});
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 &a = t[i], &b = t[(i + 1) % 3];
    const mpq_class da(plane.distance(a)), db(plane.distance(b)), ax(a.x), ay(a.y);
    if (da >= 0) add(ax, ay);
    if ((da >= 0) == (db >= 0)) continue;
    const mpq_class along(da / (da - db));
    add(mpq_class(ax + along * (mpq_class(b.x) - ax)), mpq_class(ay + along * (mpq_class(b.y) - ay)));
  }
  return polygon;
}

class ConformanceExactClips : public Conformance, public ::testing::WithParamInterface<Plane> {};

TEST_P(ConformanceExactClips, OneOrTwoVerticesBeyondAPlaneLeaveTheExactPolygon) {
  Random random(17);
  const View view{};
  int covered = 0;
  for (int trial = 0; trial < 60; ++trial)
    for (const int outside : {1, 2})
      for (int turn = 0; turn < 6; ++turn) {
        Triangle t = exactly_cut(GetParam(), outside, random);
        std::rotate(t.begin(), t.begin() + turn % 3, t.end());
        if (turn >= 3) std::swap(t[1], t[2]);
        const auto polygon = exact_polygon(t, GetParam());
        ASSERT_EQ(polygon.size(), outside == 1 ? 4u : 3u);
        auto expected = windings(polygon, view.width, view.height);
        for (int& turns : expected) covered += turns = std::abs(turns);
        for (const int bits : kClippedBits)
          expect_hits(stream_of(t), {.subpixel_bits = bits}, expected,
                      "trial " + std::to_string(trial) + ", bits " + std::to_string(bits));
        // The triangle has the polygon's facing.
        const bool front = area(polygon) > 0;
        if (area(polygon) != 0)
          expect_nothing(stream_of(t), {.cull = front ? Cull::front : Cull::back}, "culled");
        if (HasFailure()) return;
      }
  EXPECT_GT(covered, 50'000);
}

INSTANTIATE_TEST_SUITE_P(Planes, ConformanceExactClips, ::testing::ValuesIn(kPlanes),
                         [](const auto& p) { return std::string(p.param.name); });

// ---- Through a camera

constexpr lab::Size kSize{64, 48};

// The camera is at the origin and looks along -z.
Scene seen(const Mesh& mesh, float far_z) {
  Scene scene;
  scene.meshes.push_back(mesh);
  scene.instances.push_back({});
  scene.camera.near_z = 0.5f;
  scene.camera.far_z = far_z;
  return scene;
}

using ConformanceClips = Conformance;

// The exact picture decides, which needs no clipping (lab/clipping/truth.h). It sees no triangle between the
// points that it tests around a sample, so a few samples at tips and slivers may be counted as wrong.
TEST_F(ConformanceClips, VerticesUpTo100000UnitsFromTheCameraAreClippedCorrectly) {
  Random random(20);
  std::uint64_t covered = 0, wrong = 0;
  int behind[4] = {};
  for (int trial = 0; trial < 900 && !HasFailure(); ++trial) {
    Triangle t;
    for (glm::vec3& v : t) {
      const float reach = std::pow(10.0f, random.uniform(0.0f, 5.0f));
      v = {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
    }
    if (trial % 3 != 0) {
      const float w = random.uniform(1.0f, 20.0f);
      const float held_y = w * random.uniform(-0.4f, 0.4f);
      const glm::vec3 held(w * random.uniform(-0.5f, 0.5f), held_y, -w);
      t[2] = 2.0f * held - 0.5f * (t[0] + t[1]);
    }
    const Scene scene = seen({{t.begin(), t.end()}, {{0, 1, 2}}, {0}}, 5000.0f);
    const lab::ClippingOracle oracle(scene, kSize, Cull::none);
    ++behind[std::count_if(t.begin(), t.end(), [](glm::vec3 v) { return v.z > -0.5f; })];
    for (const int bits : kClippedBits) {
      std::vector<std::uint32_t> judged;  // the last picture
      const View view{.width = kSize.width, .height = kSize.height, .subpixel_bits = bits};
      with_each("trial " + std::to_string(trial), [&](Pipeline& pipeline) {
        std::vector<std::uint32_t> picture;
        for (const int hits : pipeline.hits(scene, view)) {
          ASSERT_LE(hits, 1);
          picture.push_back(hits == 1 ? 0u : kNoTriangle);
          covered += static_cast<unsigned>(hits);
        }
        if (picture != std::exchange(judged, picture)) wrong += lab::correct(picture, kSize, oracle, 1);
      });
    }
  }
  for (const int vertices : {0, 1, 2, 3})
    EXPECT_GT(behind[vertices], 20) << vertices << " behind the near plane";
  EXPECT_GT(covered, 100'000u);
  EXPECT_LE(wrong, 3u);
}

// ---- Fans

// A fan on a tilted plane around a hub in view. Its rim lies beyond all six planes, so every triangle is
// clipped. The rim is out of view, so every pixel must be hit once.
Mesh make_fan(glm::vec3 hub, glm::vec3 u, glm::vec3 v, int spokes, double turn, bool reversed) {
  Mesh fan;
  for (int i = 0; i < spokes; ++i) {
    const double angle = turn + 2 * 3.14159265358979 * i / spokes;
    fan.positions.push_back(hub + static_cast<float>(std::cos(angle)) * u +
                            static_cast<float>(std::sin(angle)) * v);
  }
  const auto n = static_cast<unsigned>(spokes);
  for (unsigned i = 0; i < n; ++i)
    fan.triangles.push_back(reversed ? glm::uvec3(n, (i + 1) % n, i) : glm::uvec3(n, i, (i + 1) % n));
  fan.positions.push_back(hub);
  fan.colours.resize(fan.triangles.size());
  return fan;
}

class ConformanceFans : public Conformance {
 protected:
  void expect_all_once(const Drawable& drawable, const Mesh& fan, View view, const std::string& name) {
    const std::vector<int> once(view.pixels(), 1);
    const auto is_drawn = [&](Cull cull) {
      view.cull = cull;
      return !pipelines().front().triangles(drawable, view).empty();
    };
    for (const int bits : kBits) {
      const std::string what = name + ", bits " + std::to_string(bits);
      view.subpixel_bits = bits, view.cull = Cull::none;
      expect_hits(drawable, view, once, what);
      const bool front = is_drawn(Cull::back);
      EXPECT_NE(front, is_drawn(Cull::front));
      view.cull = front ? Cull::back : Cull::front;
      expect_hits(drawable, view, once, what + ", the others culled");
      with_each(what, [&](Pipeline& pipeline) {
        pipeline.triangles(drawable, view);
        const FrontendStats& s = pipeline.stats();
        ASSERT_GT(s.clipped_near, 0u);
        ASSERT_GT(s.clipped_far, 0u);
        ASSERT_GT(s.clipped_guard, 0u);
        ASSERT_EQ(s.triangles, fan.triangles.size());
      });
    }
  }
};

TEST_F(ConformanceFans, CutByAllSixPlanesHitEachPixelOnce) {
  Random random(21), of_camera(22);
  for (int trial = 0; trial < 60 && !HasFailure(); ++trial) {
    const std::string what = "trial " + std::to_string(trial);
    const glm::vec3 hub(random.uniform(1.0f, 63.0f), random.uniform(1.0f, 63.0f), 0.5f);
    // Depth changes by less than 0.3 over the screen, and by more than 1 over the fan.
    const glm::vec2 slope(random.uniform(2e-4f, 1e-3f), random.uniform(2e-4f, 1e-3f));
    const float reach = random.uniform(60'000.0f, 100'000.0f);
    const Mesh fan = make_fan(hub, {reach, 0, reach * slope.x}, {0, reach, reach * slope.y}, 4 + trial % 21,
                              random.uniform(0.0f, 6.0f), trial % 2 == 0);
    expect_all_once(conformance::stream_of(fan.positions, fan.triangles), fan, {}, what);

    const auto number = [&](float low, float high) { return of_camera.uniform(low, high); };
    const float w = number(2.0f, 20.0f), far_out = number(50'000.0f, 100'000.0f);
    const glm::vec3 ahead(number(-0.4f, 0.4f) * w, number(-0.4f, 0.4f) * w, -w);
    // Tilted: outside the view, one side lies behind the camera and the other beyond the far plane.
    const glm::vec3 u(far_out, 0, far_out * number(0.1f, 0.7f)), v(0, far_out, far_out * number(0.1f, 0.7f));
    const Mesh tilted = make_fan(ahead, u, v, 4 + trial % 21, number(0.0f, 6.0f), trial % 2 == 0);
    expect_all_once(seen(tilted, 1000.0f), tilted, {kSize.width, kSize.height}, what + ", camera");
  }
}

}  // namespace
}  // namespace edgewise::conformance

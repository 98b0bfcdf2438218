// Fill rules: rotated quads of two triangles, with hit counts added up. Every pixel of the quad is hit once,
// for both diagonals, both windings and every first vertex. The quad's outline follows the same rule, so its
// winding number is the expected count.
#include <glm/glm.hpp>
#include <numbers>

#include "conformance/pipeline.h"
#include "core/random.h"

namespace edgewise::conformance {
namespace {

class ConformanceFillRules : public Conformance {
 protected:
  // Checks all ways to split the quad into two triangles.
  void expect_filled(const Quad& quad, View view, const std::string& what) {
    for (const int bits : kBits) {
      view.subpixel_bits = bits;
      const auto corners = snapped(quad, bits);
      const auto expected = windings(corners, view.width, view.height);
      for (const Split& split : kSplits)
        expect_hits(stream_of(quad, {split.a, split.b}), view, expected,
                    what + ", " + split.name + ", bits " + std::to_string(bits));
    }
  }
};

TEST_F(ConformanceFillRules, QuadsOnTheLatticeAreHitOnceAtEveryAngle) {
  for (const auto& direction : kDirections)
    for (const double corner : {0.0, 0.5})
      expect_filled(on_lattice(direction, corner), {},
                    "direction " + std::to_string(direction.first) + ":" + std::to_string(direction.second));
}

// Quads in the image, and quads that leave it. If a quad contains the image, the hit count is 1 in every
// pixel, without an oracle.
TEST_F(ConformanceFillRules, QuadsAtAnyAngleAreHitOnce) {
  Random random(3);
  for (int step = 0; step < 36; ++step) {
    const double angle = step * std::numbers::pi / 18;
    const glm::dvec2 along(std::cos(angle), std::sin(angle)),
        centre(random.uniform(20.0f, 44.0f), random.uniform(20.0f, 44.0f));
    expect_filled(rotated(centre, random.uniform(0.4f, 26.0f), along), {}, "step " + std::to_string(step));
    if (step % 3 != 0) continue;
    for (const double half : {30.0, 200.0, 9000.0}) {
      const View view{33, 47};
      const auto quad = rotated({16.5, 23.5}, half, along);
      expect_filled(quad, view, "half " + std::to_string(half) + ", step " + std::to_string(step));
      const auto all = windings(snapped(quad, 8), view.width, view.height);
      EXPECT_TRUE(half < 100 || std::count(all.begin(), all.end(), 1) == 33 * 47);
    }
  }
}

// ---- Triangles without area draw nothing: points, lines, and triangles that snapping flattens.

class ConformanceDegenerate : public Conformance {
 protected:
  void expect_flat(const std::vector<glm::vec3>& v, int bits, const std::string& what) {
    std::vector<glm::uvec3> triangles;
    for (unsigned i = 0; i + 2 < v.size(); i += 3)
      for (const glm::uvec3 order :
           {glm::uvec3(0, 1, 2), glm::uvec3(1, 2, 0), glm::uvec3(2, 0, 1), glm::uvec3(2, 1, 0)})
        triangles.push_back(order + i);
    for (const Cull cull : cull_modes())
      expect_nothing(stream_of(v, triangles), {.cull = cull, .subpixel_bits = bits},
                     what + ", cull " + std::string(name_of(cull)) + ", bits " + std::to_string(bits));
  }
};

// Triangles with area in float, whose vertices are collinear or equal after rounding.
TEST_F(ConformanceDegenerate, TrianglesThatSnappingFlattensDrawNothing) {
  Random random(5);
  for (const int bits : kBits) {
    std::vector<glm::vec3> v;
    const float less_than_half = std::ldexp(0.486f, -bits);
    const auto jitter = [&] { return random.uniform(-less_than_half, less_than_half); };
    for (int i = 0; i < 200; ++i) {
      const glm::vec2 from(random.below(64), random.below(64)), step(random.below(5), random.below(5));
      for (int k = 0; k < 3; ++k) {
        const glm::vec2 p = from + step * static_cast<float>(k) + glm::vec2(jitter(), jitter());
        v.emplace_back(p, random.uniform(0.0f, 1.0f));
      }
      ASSERT_TRUE(area(snapped(std::span(v).last(3), bits)) == 0);
    }
    expect_flat(v, bits, "flattened");
  }
}

// Triangles without area that cross every clipping plane: the clipped parts have no area either.
TEST_F(ConformanceDegenerate, ClippedFlatTrianglesDrawNothing) {
  std::vector<glm::vec3> v;
  for (const glm::vec3 d :
       {glm::vec3(1, 0, 0), {0, 1, 0}, {1, 1, 0}, {1, -1, 1}, {-1, 0.5f, 1}, {0.25f, 1, -1}}) {
    const glm::vec3 reach = d * glm::vec3(65536, 65536, 2), middle(32, 32, 0.5f);
    v.insert(v.end(), {middle - reach, middle, middle + reach});
    v.insert(v.end(), {middle - reach, middle + reach, middle - reach});
    v.insert(v.end(), {middle + reach, middle + reach, middle + reach});
  }
  for (const int bits : kBits) expect_flat(v, bits, "clipped");
}

}  // namespace
}  // namespace edgewise::conformance

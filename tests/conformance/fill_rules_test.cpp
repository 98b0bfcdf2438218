// Fill rules: rotated quads of two triangles, with hit counts added up. Every pixel of the quad is hit once,
// for both diagonals, both windings and every first vertex. The quad's outline follows the same rule, so its
// winding number is the expected count.
#include <array>
#include <glm/glm.hpp>
#include <numbers>

#include "conformance/pipeline.h"
#include "core/random.h"

namespace edgewise::conformance {
namespace {

class ConformanceFillRules : public Conformance {
 protected:
  // Checks all ways to split the quad into two triangles.
  void expect_filled(const std::array<glm::vec3, 4>& quad, const View& view, const std::string& what) {
    const auto expected = windings(snapped(quad), view.width, view.height);
    const std::vector<glm::vec3> v(quad.begin(), quad.end());
    for (const auto& [cut, a, b] : {std::tuple("one diagonal", glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)),
                                    {"the other diagonal", {0, 1, 3}, {1, 2, 3}},
                                    {"started elsewhere", {2, 0, 1}, {3, 0, 2}},
                                    {"last one first", {2, 3, 1}, {3, 0, 1}}})
      expect_hits(stream_of(v, {a, b}), view, expected, what + ", " + cut);
    // Reverses the first triangle, the second, or both.
    expect_hits(stream_of(v, {{0, 2, 1}, {0, 2, 3}}), view, expected, what + ", first reversed");
    expect_hits(stream_of(v, {{0, 2, 1}, {0, 3, 2}}), view, expected, what + ", both reversed");
    ties_ += ties(snapped(quad[0]), snapped(quad[2]), view.width, view.height) +
             ties(snapped(quad[1]), snapped(quad[3]), view.width, view.height);
  }

  int ties_ = 0;  // samples exactly on a shared diagonal
};

std::array<glm::vec3, 4> rotated(glm::dvec2 centre, double half, glm::dvec2 along) {
  const glm::dvec2 across(-along.y, along.x);
  const auto corner = [&](double a, double b) {
    const glm::dvec2 p = centre + half * (a * along + b * across);
    return glm::vec3(static_cast<float>(p.x), static_cast<float>(p.y), 0.5f);
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

// Directions with whole coordinates, so that corners stay on the lattice and the diagonals pass through
// samples.
TEST_F(ConformanceFillRules, QuadsOnTheLatticeAreHitOnceAtEveryAngle) {
  for (const auto& [x, y] :
       {std::pair{1, 0}, {1, 1}, {2, 1}, {3, 1}, {3, 2}, {3, 4}, {5, 12}, {7, 1}, {1, 9}})
    for (const double corner : {0.0, 0.5}) {
      const glm::dvec2 along(x, y);
      const double half = std::floor(28 / (std::abs(x) + std::abs(y)));
      expect_filled(rotated(glm::dvec2(32 + corner), half, along), {},
                    "direction " + std::to_string(x) + ":" + std::to_string(y));
    }
  EXPECT_GT(ties_, 500) << "too few samples on edges to test the tie rule";
  RecordProperty("ties", ties_);
}

TEST_F(ConformanceFillRules, QuadsAtAnyAngleAreHitOnce) {
  Random random(3);
  for (int step = 0; step < 36; ++step) {
    const double angle = step * std::numbers::pi / 18;
    const glm::dvec2 centre(random.uniform(20.0f, 44.0f), random.uniform(20.0f, 44.0f));
    expect_filled(rotated(centre, random.uniform(0.4f, 26.0f), {std::cos(angle), std::sin(angle)}), {},
                  "step " + std::to_string(step));
  }
}

// Quads that leave the image. If a quad contains the image, the hit count is 1 in every pixel, without an
// oracle.
TEST_F(ConformanceFillRules, QuadsAcrossTheImagesEdgesAreHitOnce) {
  for (int step = 0; step < 12; ++step) {
    const double angle = 0.1 + step * std::numbers::pi / 6;
    const glm::dvec2 along(std::cos(angle), std::sin(angle));
    for (const double half : {30.0, 200.0, 9000.0}) {
      const View view{33, 47};
      const auto quad = rotated({16.5, 23.5}, half, along);
      expect_filled(quad, view, "half " + std::to_string(half) + ", step " + std::to_string(step));
      if (half > 100) {
        const auto all = windings(snapped(quad), view.width, view.height);
        EXPECT_EQ(std::count(all.begin(), all.end(), 1), 33 * 47);
      }
    }
  }
}

// A fan of triangles around a vertex that lies on a sample: exactly one of them covers it.
TEST_F(ConformanceFillRules, ASampleUnderTheHubOfAFanIsHitOnce) {
  for (int spokes = 3; spokes <= 40; ++spokes)
    for (const float corner : {0.0f, 0.5f}) {
      std::vector<glm::vec3> v;
      std::vector<glm::uvec3> fan;
      for (int i = 0; i < spokes; ++i) {
        const double angle = 2 * std::numbers::pi * i / spokes;
        v.emplace_back(20 + corner + static_cast<float>(std::round(17 * std::cos(angle))),
                       20 + corner + static_cast<float>(std::round(17 * std::sin(angle))), 0.5f);
        const auto at = static_cast<unsigned>(i);
        fan.emplace_back(spokes, at, (at + 1) % static_cast<unsigned>(spokes));
      }
      const auto expected = windings(snapped(v), 40, 40);
      v.emplace_back(20 + corner, 20 + corner, 0.5f);
      expect_hits(stream_of(v, fan), {40, 40}, expected, std::to_string(spokes) + " spokes");
    }
}

// All vertices lie on samples, and every edge of every cell passes through samples.
TEST_F(ConformanceFillRules, ATessellationWithVerticesOnSamplesHitsEachOnce) {
  for (const int cell : {1, 2, 3, 7}) {
    const View view{40, 40};
    std::vector<glm::vec3> v;
    std::vector<glm::uvec3> triangles;
    const unsigned side = static_cast<unsigned>(44 / cell) + 2;
    for (unsigned j = 0; j < side; ++j)
      for (unsigned i = 0; i < side; ++i) {
        v.emplace_back(static_cast<float>(i) * static_cast<float>(cell) - 1.5f,
                       static_cast<float>(j) * static_cast<float>(cell) - 1.5f, 0.5f);
        if (i + 1 == side || j + 1 == side) continue;
        const unsigned at = j * side + i, below = at + side;
        if ((i + j) % 2 == 0)
          triangles.insert(triangles.end(), {{at, at + 1, below}, {at + 1, below + 1, below}});
        else
          triangles.insert(triangles.end(), {{at, at + 1, below + 1}, {at, below + 1, below}});
      }
    expect_hits(stream_of(v, triangles), view, std::vector<int>(1600, 1), "cells of " + std::to_string(cell));
  }
}

// Through a camera: both triangles use the same four projected positions, and so does the outline.
TEST_F(ConformanceFillRules, QuadsInPerspectiveAreHitOnce) {
  Random random(11);
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene;
    Mesh mesh;
    const glm::dvec2 along(random.direction());
    const float tilt_x = random.uniform(-0.5f, 0.5f), tilt_y = random.uniform(-0.5f, 0.5f);
    for (const glm::vec3 p : rotated({0, 0}, random.uniform(0.3f, 3.0f), along))
      mesh.positions.emplace_back(p.x, p.y, -5 + tilt_x * p.x + tilt_y * p.y);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.colours = {1, 2};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({});
    const View view{61, 43};
    with_each("trial " + std::to_string(trial), [&](Pipeline& pipeline) {
      const auto t = pipeline.triangles(scene, view);
      ASSERT_EQ(t.size(), 2u);
      const auto at = [](const ScreenTriangle& s, int i) { return SubPosition{s.x_sub[i], s.y_sub[i]}; };
      const std::array outline{at(t[0], 0), at(t[0], 1), at(t[0], 2), at(t[1], 2)};
      ASSERT_EQ(t[0].x_sub[0], t[1].x_sub[0]);
      ASSERT_EQ(t[0].x_sub[2], t[1].x_sub[1]);
      const auto expected = windings(outline, view.width, view.height);
      const auto hits = pipeline.hits(scene, view);
      for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i], std::abs(expected[i]));
    });
  }
}

}  // namespace
}  // namespace edgewise::conformance

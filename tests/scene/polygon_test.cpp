// Polygons are filled exactly once.
#include "scene/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace edgewise {
namespace {

using Polygon = std::vector<glm::dvec2>;

double twice_area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// All triangles have the polygon's winding, and their areas add up to its area: they fill it exactly once.
void expect_filled(const Polygon& polygon, const std::string& what, int axes = 3) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += twice_area(polygon[0], polygon[i], polygon[i + 1]);
  for (int axis = 0; axis < axes; ++axis) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const glm::dvec2 p : polygon) {
      const double in_3d[3] = {p.x, p.y, 3.0};
      positions.emplace_back(in_3d[axis % 3], in_3d[(axis + 1) % 3], in_3d[(axis + 2) % 3]);
      indices.push_back(static_cast<std::uint32_t>(indices.size()));
    }
    std::vector<glm::uvec3> triangles;
    std::uint64_t steps_left = 100'000'000;
    triangulate(positions, indices, triangles, steps_left);
    EXPECT_EQ(triangles.size(), polygon.size() - 2) << what;
    double sum = 0.0, smallest = 0.0;
    for (const glm::uvec3 t : triangles) {
      const double part = twice_area(polygon[t.x], polygon[t.y], polygon[t.z]) * (area < 0 ? -1 : 1);
      sum += part;
      smallest = std::min(smallest, part);
    }
    EXPECT_GE(smallest, -1e-6 * std::fabs(area)) << what;
    EXPECT_NEAR(sum, std::fabs(area), 1e-5 * std::fabs(area)) << what;
  }
}

void expect_filled_both_ways(Polygon polygon, const std::string& what) {
  for (std::size_t turn = 0; turn < std::min<std::size_t>(polygon.size(), 12); ++turn) {
    std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    expect_filled(polygon, what);
    std::reverse(polygon.begin(), polygon.end());
    expect_filled(polygon, what + " reversed");
  }
}

TEST(Polygon, ConcaveShapesAreFilledOnceAtEveryPosition) {
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(100, 50), glm::dvec2(-30, 7)}) {
    const auto moved = [&](Polygon polygon) {
      for (glm::dvec2& p : polygon) p += at;
      return polygon;
    };
    expect_filled_both_ways(moved({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), "square");
    expect_filled_both_ways(moved({{0, 0}, {10, 1}, {0, 2}, {9, 1}}), "dart");
    expect_filled_both_ways(moved({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}), "L");
    expect_filled_both_ways(moved({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}}), "square with midpoints");
    expect_filled_both_ways(
        moved({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}),
        "square with a bridged hole");
    Polygon comb{{0, 0}, {7, 0}, {7, 5}, {6, 5}};
    for (const int x : {6, 4, 2}) {
      const glm::dvec2 gap[] = {{x, 1}, {x - 1, 1}, {x - 1, 5}, {x - 2, 5}};
      comb.insert(comb.end(), std::begin(gap), std::end(gap));
    }
    expect_filled_both_ways(moved(comb), "comb");
  }
}

TEST(Polygon, RandomStarsAreFilledOnce) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Polygon star;
    const std::size_t corners = 4 + random() % 40;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = 1.0 + static_cast<double>(random() % 1000) / 100.0;
      star.push_back(glm::dvec2(std::cos(angle), std::sin(angle)) * radius);
    }
    expect_filled(star, "star " + std::to_string(trial));
  }
}

TEST(Polygon, OfNoAreaOrSelfCrossingIsTriangulated) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}, {3, 3, 0}};
  for (const std::vector<std::uint32_t>& polygon :
       {std::vector<std::uint32_t>{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 0, 0, 0, 0}, {0, 2, 2, 1, 0, 3}}) {
    std::vector<glm::uvec3> triangles;
    std::uint64_t steps_left = 1000;
    triangulate(positions, polygon, triangles, steps_left);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
  }
}

TEST(Polygon, OfManyCornersIsFilledOnce) {
  Polygon circle, comb{{20000, -1}, {0, -1}};
  for (int i = 0; i < 100000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100000;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (int i = 0; i < 20000; ++i) comb.emplace_back(i, i % 2);
  expect_filled(circle, "circle");
  expect_filled(comb, "comb");
  // All slits overlap in each direction of the axes.
  for (const double angle : {0.0, 0.8}) {
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
    Polygon slits;
    for (int i = 0; i < 20000; ++i)
      for (const glm::dvec2 p : {glm::dvec2(1, 0), glm::dvec2(9, 0), glm::dvec2(9, 1), glm::dvec2(1, 1)})
        slits.push_back(1000.0 * p.x * along + (2.0 * i + p.y) * across);
    slits.push_back(40000.0 * across), slits.push_back(glm::dvec2(0.0));
    expect_filled(slits, "slits", 1);
  }
}

}  // namespace
}  // namespace edgewise

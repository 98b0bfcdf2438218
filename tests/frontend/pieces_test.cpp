// Clipped polygons are split into triangles of one winding if such a split exists.
#include "frontend/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace edgewise {
namespace {

using Polygon = std::vector<Vertex>;

Polygon polygon_of(std::initializer_list<std::pair<int, int>> positions) {
  Polygon polygon;
  for (const auto& [x, y] : positions) polygon.push_back({x, y, 0, 0});
  return polygon;
}

std::int64_t area(const Vertex& a, const Vertex& b, const Vertex& c) {
  return std::int64_t{b.x_sub - a.x_sub} * (c.y_sub - a.y_sub) -
         std::int64_t{b.y_sub - a.y_sub} * (c.x_sub - a.x_sub);
}

struct Areas {
  std::int64_t sum = 0;
  bool positive = false, negative = false;
};
Areas areas(const Polygon& polygon, const Pieces& pieces) {
  Areas all;
  for (std::size_t i = 0; i < pieces.count; ++i) {
    const auto [a, b, c] = pieces.corners[i];
    const std::int64_t one = area(polygon.at(a), polygon.at(b), polygon.at(c));
    all.sum += one;
    all.positive |= one > 0;
    all.negative |= one < 0;
  }
  return all;
}

TEST(Pieces, AConvexPolygonBecomesAFan) {
  const Polygon hexagon = polygon_of({{0, 0}, {20, -10}, {40, 0}, {40, 20}, {20, 30}, {0, 20}});
  const Pieces pieces = split(hexagon);
  ASSERT_EQ(pieces.count, 4u);
  for (std::uint8_t i = 0; i < 4; ++i)
    EXPECT_EQ(pieces.corners[i], (std::array<std::uint8_t, 3>{0, std::uint8_t(i + 1), std::uint8_t(i + 2)}));
}

TEST(Pieces, PiecesOfAConcavePolygonKeepItsWinding) {
  // Vertex 1 of each is concave, so a fan from vertex 0 has a triangle of the opposite winding.
  for (const Polygon& forward :
       {polygon_of({{0, 0}, {50, 1}, {100, 0}, {50, 90}}),
        polygon_of({{0, 0}, {1, 1}, {100, 0}, {100, 90}, {0, 90}}),
        polygon_of({{0, 0}, {30, 1}, {100, 0}, {99, 40}, {100, 90}, {50, 89}, {0, 90}, {1, 50}, {2, 49}})}) {
    const Polygon backward(forward.rbegin(), forward.rend());
    for (Polygon polygon : {forward, backward})
      for (std::size_t turn = 0; turn < polygon.size(); ++turn) {
        const Areas fan = areas(polygon, [&] {
          Pieces pieces;
          for (std::uint8_t i = 2; i < polygon.size(); ++i)
            pieces.corners[pieces.count++] = {0, std::uint8_t(i - 1), i};
          return pieces;
        }());
        const Pieces pieces = split(polygon);
        EXPECT_EQ(pieces.count, polygon.size() - 2);
        const Areas found = areas(polygon, pieces);
        EXPECT_EQ(found.sum, fan.sum);
        EXPECT_FALSE(found.positive && found.negative) << "turn " << turn;
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      }
  }
}

TEST(Pieces, ASelfCrossingPolygonKeepsItsArea) {
  const Polygon bow = polygon_of({{0, 0}, {100, 10}, {100, 0}, {0, 9}});
  const Pieces pieces = split(bow);
  ASSERT_EQ(pieces.count, 2u);
  EXPECT_EQ(areas(bow, pieces).sum, area(bow[0], bow[1], bow[2]) + area(bow[0], bow[2], bow[3]));
}

}  // namespace
}  // namespace edgewise

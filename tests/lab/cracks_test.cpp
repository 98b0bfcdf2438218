// Cracks at shared edges, T-junctions and folds, in pictures whose counts are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "lab/coverage_support.h"

namespace edgewise::lab {
namespace {

using testing::cracks_of;
using testing::Picture;

FloatTriangle triangle(float x0, float y0, float x1, float y1, float x2, float y2, float z = 0.5f) {
  return {{{x0, x1, x2}, {y0, y1, y2}, {z, z, z}}, 1};
}

// Covers the whole window.
FloatTriangle screen(float z) {
  return triangle(-1, -1, 200, -1, -1, 200, z);
}

// Two triangles whose common edge runs through 48 samples.
std::vector<FloatTriangle> quad(float z = 0.5f) {
  return {triangle(8, 8, 56, 8, 56, 56, z), triangle(8, 8, 56, 56, 8, 56, z)};
}

// A vertex in the middle of the first triangle's edge.
std::vector<FloatTriangle> t_junction() {
  return {triangle(10.37f, 5.13f, 50.91f, 58.77f, 4, 60), triangle(10.37f, 5.13f, 60, 4, 30.64f, 31.95f),
          triangle(30.64f, 31.95f, 60, 4, 50.91f, 58.77f)};
}

constexpr Window kWindow{64, 64};

std::vector<FloatTriangle> with(FloatTriangle also, std::vector<FloatTriangle> list, bool first) {
  list.insert(first ? list.begin() : list.end(), also);
  return list;
}

TEST(Cracks, AreTheSameWhateverLiesBehindOrInFront) {
  for (const float z : {0.1f, 0.9f})
    for (const bool first : {true, false}) {
      const Picture alone(quad(), kWindow), among(with(screen(z), quad(), first), kWindow);
      for (const Picture* picture : {&alone, &among}) {
        EXPECT_EQ(cracks_of("float_lt", *picture).gaps.size(), 48u) << z;
        EXPECT_EQ(cracks_of("float_lt", *picture).double_hits.size(), 0u) << z;
        EXPECT_EQ(cracks_of("float_le", *picture).double_hits.size(), 48u) << z;
        EXPECT_EQ(cracks_of("float_le", *picture).gaps.size(), 0u) << z;
        EXPECT_EQ(cracks_of("float_top_left", *picture).at_shared_edges(), 0u) << z;
      }
      const Picture open(t_junction(), kWindow), before(with(screen(z), t_junction(), first), kWindow);
      ASSERT_EQ(cracks_of("whole_pixel", open).at_t_junctions(), 12u);
      for (const char* method : {"tiled", "whole_pixel", "fixed_4", "float_le", "dda_float"}) {
        const Cracks expected = cracks_of(method, open), found = cracks_of(method, before);
        EXPECT_EQ(found.t_gaps, expected.t_gaps) << method;
        EXPECT_EQ(found.t_double_hits, expected.t_double_hits) << method;
      }
    }
}

TEST(Cracks, OfATJunctionCountApartAndCloseWithEnoughBits) {
  const Picture open(t_junction(), kWindow);
  for (const char* method : {"whole_pixel", "fixed_4", "fixed_8", "tiled"})
    EXPECT_EQ(cracks_of(method, open).at_shared_edges(), 0u) << method;
  EXPECT_EQ(cracks_of("fixed_16", open).at_t_junctions(), 0u);
  auto apart = t_junction();
  for (float& z : apart[0].at.z01) z = 0.25f;  // an outline before another surface
  EXPECT_EQ(cracks_of("whole_pixel", Picture(apart, kWindow)).at_t_junctions(), 0u);
}

// Edges that overlap in part, as in a wall of bricks: the middle of each lies inside the other.
TEST(Cracks, AreFoundAlongEdgesThatOverlapInPart) {
  const Picture bricks(
      {triangle(4.5f, 20.5f, 40.5f, 38.5f, 10, 50), triangle(24.5f, 30.5f, 30, 8, 60.5f, 48.5f)}, kWindow);
  const Cracks cracks = cracks_of("float_lt", bricks);
  EXPECT_GT(cracks.t_gaps.size(), 5u);
  EXPECT_EQ(cracks.at_shared_edges(), 0u);
}

// Rounded to whole pixels, the second triangle's third vertex lies below the edge that both share. It then
// covers the three samples of row 7 between x = 9 and 12.
TEST(Cracks, FoldsAreNone) {
  const Picture picture({triangle(0, 7, 24, 7.8f, 12, 16), triangle(0, 7, 24, 7.8f, 18, 7.55f)}, kWindow);
  const Cracks folded = cracks_of("whole_pixel", picture), held = cracks_of("tiled", picture);
  EXPECT_EQ(folded.folds.size(), 3u);
  EXPECT_EQ(folded.at_shared_edges(), 0u);
  EXPECT_EQ(held.folds.size() + held.at_shared_edges(), 0u);
  const Picture before({triangle(0, 0, 40.3f, 0, 0, 40), triangle(0, 0, 30.3f, 2.3f, 10.7f, 25.6f, 0.5f)},
                       kWindow);
  EXPECT_EQ(cracks_of("whole_pixel", before).folds.size(), 0u) << "they overlap before rounding, too";
}

// Of four triangles at one edge, the first on each side belong together, and the second.
TEST(Cracks, OfCoincidentSurfacesCountInEach) {
  auto twice = quad();
  for (const FloatTriangle& t : quad()) twice.push_back(t);
  EXPECT_EQ(cracks_of("float_lt", Picture(twice, kWindow)).gaps.size(), 96u);
  for (const float z : {0.5f, 0.7f})
    EXPECT_EQ(cracks_of("float_lt", Picture(with(quad(z)[0], quad(), false), kWindow)).gaps.size(), 48u)
        << "the third triangle has none across its edge";
  EXPECT_EQ(cracks_of("float_lt", Picture({quad(0.5f)[0], quad(0.7f)[1]}, kWindow)).gaps.size(), 0u)
      << "other depths: no common vertex";
}

// The second triangle's copy of the corner (56, 56), moved by one ulp: apart from the first triangle or over
// it.
struct MovedCopy {
  float (UnsnappedTriangle::*axis)[3];
  bool up, overlaps;
};
constexpr MovedCopy kMovedCopies[] = {
    {&UnsnappedTriangle::x_px, false, false}, {&UnsnappedTriangle::x_px, true, true},
    {&UnsnappedTriangle::y_px, true, false},  {&UnsnappedTriangle::y_px, false, true},
    {&UnsnappedTriangle::z01, true, false},   {&UnsnappedTriangle::z01, false, false},
};
std::vector<FloatTriangle> with_copy(const MovedCopy& copy) {
  auto list = quad();
  float& at = (list[1].at.*copy.axis)[1];
  at = std::nextafter(at, copy.up ? std::numeric_limits<float>::infinity() : 0.0f);
  return list;
}

TEST(Cracks, AreTheSameWhereCopiesOfAVertexDifferInTheLastBit) {
  for (const MovedCopy& copy : kMovedCopies)
    for (const bool reversed : {false, true}) {
      auto list = with_copy(copy);
      if (reversed) std::ranges::reverse(list);
      const Picture picture(list, kWindow);
      EXPECT_EQ(picture.cracks.surface().crossings(kWindow), Surface(quad()).crossings(kWindow));
      EXPECT_TRUE(touch(list[0].at, list[1].at));
      for (const char* snapping : {"tiled", "fixed_4", "fixed_8"})
        EXPECT_EQ(cracks_of(snapping, picture).at_shared_edges(), 0u) << snapping;
      const Cracks exact = cracks_of("double_top_left", picture);
      EXPECT_EQ(exact.double_hits.size(), copy.overlaps ? 48u : 0u) << "exact edges that overlap";
      EXPECT_EQ(exact.gaps.size(), 0u);
      if (copy.overlaps) continue;
      EXPECT_EQ(cracks_of("float_lt", picture).gaps.size(), 48u);
      EXPECT_EQ(cracks_of("float_lt", picture).double_hits.size(), 0u);
    }
}

// Each triangle around the hub has its own copy of it.
TEST(Cracks, AtAVertexWithManyCopiesAreThoseOfOneVertex) {
  const auto fan = [](float step, bool reversed) {
    constexpr float kRim[][2] = {{32, 2}, {60, 14}, {58, 50}, {30, 62}, {3, 48}, {5, 11}};
    std::vector<FloatTriangle> list;
    for (int i = 0; i < 6; ++i) {
      const float *from = kRim[i], *to = kRim[(i + 1) % 6];
      list.push_back(triangle(32, 32, from[0], from[1], to[0], to[1]));
      list.back().at.z01[0] += static_cast<float>(i * 5 % 6) * step;
    }
    if (reversed) std::ranges::reverse(list);
    return list;
  };
  const Picture one(fan(0, false), kWindow);
  for (const bool reversed : {false, true}) {
    const Picture copies(fan(0x1p-23f, reversed), kWindow);
    EXPECT_TRUE(copies.cracks.surface().moved() && !one.cracks.surface().moved());
    EXPECT_EQ(cracks_of("float_lt", copies).gaps.size(), cracks_of("float_lt", one).gaps.size());
    EXPECT_EQ(cracks_of("float_le", copies).double_hits.size(), 7u);
  }
}

TEST(Cracks, AreNoneBetweenSurfacesNearOneAnother) {
  for (const MovedCopy& copy : kMovedCopies) {
    auto list = quad();
    const bool depth = copy.axis == &UnsnappedTriangle::z01;
    for (int i = 0; i < 3; ++i)
      (list[1].at.*copy.axis)[i] += (copy.up ? 1 : -1) * (depth ? 0x1p-19f : 0x1p-9f);
    const Picture picture(list, kWindow);
    EXPECT_EQ(picture.cracks.surface().crossings(kWindow), 0u);
    for (const char* method : {"float_lt", "float_le", "tiled", "double_top_left"})
      EXPECT_EQ(cracks_of(method, picture).at_shared_edges() + cracks_of(method, picture).at_t_junctions(),
                0u)
          << method;
  }
}

// A sample that one triangle loses to its neighbour is wrong, but no crack.
TEST(Cracks, AreWhereNeitherOrBothDraw) {
  const Picture picture(quad(), kWindow);
  const auto expect_counted = [&](bool lost, bool drawn_by_the_other) {
    auto runs = picture.by_floats.runs;
    const auto row = std::ranges::find(runs, 20, &lab::Run::y);
    const int x = row->x0;
    if (lost) ++row->x0;
    if (drawn_by_the_other) runs.push_back({1, 20, x, x + 1});
    const Cracks cracks = picture.cracks.find({runs, kWindow}, std::nullopt);
    EXPECT_EQ(cracks.gaps.size(), lost && !drawn_by_the_other ? 1u : 0u);
    EXPECT_EQ(cracks.double_hits.size(), !lost && drawn_by_the_other ? 1u : 0u);
  };
  for (const bool lost : {false, true})
    for (const bool drawn_by_the_other : {false, true}) expect_counted(lost, drawn_by_the_other);
}

TEST(Crossings, OfSharedEdgesCountOncePerPairOfTriangles) {
  const FloatTriangle one = triangle(0, 0, 30, 10, 30, 0), two = triangle(0, 0, 30, 10, 0, 9),
                      moved = triangle(0, 1, 30, 10, 0, 9), same_side = triangle(0, 0, 30, 10, 20, 1);
  const auto crossings = [](std::vector<FloatTriangle> list) { return Surface(list).crossings({100, 50}); };
  EXPECT_EQ(crossings({one, two}), 30u);
  EXPECT_EQ(crossings({one, two, two}), 30u);
  EXPECT_EQ(crossings({one, two, one, two}), 60u);
  EXPECT_EQ(crossings({one, moved}), 0u);
  EXPECT_EQ(crossings({one, same_side}), 0u) << "on one side of the edge: a fold of the surface";
  EXPECT_EQ(largest_side_px(std::vector{one, two}), 30.0f);
}

}  // namespace
}  // namespace edgewise::lab

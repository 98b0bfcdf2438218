// Properties of coverage, checked on hit counts: each triangle is drawn without occlusion by the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lab/measure.h"
#include "lab/truth.h"
#include "properties/move.h"
#include "properties/pictures.h"
#include "properties/streams.h"
#include "support.h"

namespace edgewise::testing {
namespace {

using Hits = std::vector<std::uint32_t>;  // row by row

// Empty where the counts are the same.
std::string hits_text(const Hits& expected, const Hits& actual, int width) {
  const auto at = std::mismatch(expected.begin(), expected.end(), actual.begin(), actual.end());
  if (at.first == expected.end() && at.second == actual.end()) return {};
  const auto pixel = static_cast<int>(at.first - expected.begin());
  return "hits differ, first at (" + std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
         "): " + std::to_string(*at.first) + " and " + std::to_string(*at.second);
}

// By the exact truth.
Hits covered_counts(std::span<const ScreenTriangle> triangles, const TriangleStream& stream) {
  Hits counts(static_cast<std::size_t>(stream.width) * static_cast<std::size_t>(stream.height), 0);
  for (const lab::Run& run : lab::covered_runs(triangles, {stream.width, stream.height}, 1))
    for (int x = run.x0; x < run.x1; ++x) ++counts[static_cast<std::size_t>(run.y * stream.width + x)];
  return counts;
}

class CoverageProperties : public ::testing::Test {
 protected:
  const std::vector<Painter> painters_ = painters(backends());

  static Hits hits(const Painter& painter, std::span<const ScreenTriangle> triangles,
                   const TriangleStream& stream, const lab::AblatedExecution& way) {
    return lab::count_hits(painter.with({}), triangles, stream.width, stream.height, way.execution);
  }

  template <typename Judge>
  void for_each_way(Judge&& judge) const {
    for (const Painter& painter : painters_)
      for (const lab::AblatedExecution& way : two_executions())
        judge(painter, way, std::string(painter.name) + ", " + describe(way));
  }
};

TEST_F(CoverageProperties, EveryPointOfATessellatedPlaneIsCoveredOnce) {
  check(tessellations(), 3'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    const auto triangles = snapped(stream, Payload::id);
    const Hits once(static_cast<std::size_t>(stream.width * stream.height), 1);
    verdict.compare(hits_text(once, covered_counts(triangles, stream), stream.width), "the exact truth");
    for_each_way([&](const Painter& painter, const lab::AblatedExecution& way, const std::string& what) {
      verdict.compare(hits_text(once, hits(painter, triangles, stream, way), stream.width), what);
    });
    return verdict;
  });
}

// The triangle cut in two at a point of the grid on edge `edge`, if there is one: `tenths` along it, or near.
std::vector<StreamTriangle> cut(const StreamTriangle& t, int edge, int tenths) {
  const glm::vec3 &a = t.vertex[edge], &b = t.vertex[(edge + 1) % 3], &c = t.vertex[(edge + 2) % 3];
  const glm::ivec2 from(glm::vec2(a) * 256.0f), to(glm::vec2(b) * 256.0f), along = to - from;
  const int steps = std::gcd(along.x, along.y);
  if (steps < 2) return {};
  const int step = std::clamp(static_cast<int>(std::int64_t{steps} * tenths / 10), 1, steps - 1);
  const glm::vec3 middle(glm::vec2(from + along / steps * step) / 256.0f, 0.5f);
  return {{{a, middle, c}, t.colour}, {{middle, b, c}, t.colour}};
}

// The triangle at the other side of an edge that completes a parallelogram, if it is within the guard band.
std::vector<StreamTriangle> neighbour(const StreamTriangle& t, int edge) {
  const glm::vec3 &a = t.vertex[edge], &b = t.vertex[(edge + 1) % 3], &c = t.vertex[(edge + 2) % 3];
  const glm::vec2 opposite = glm::vec2(a) + glm::vec2(b) - glm::vec2(c);
  if (std::max(std::abs(opposite.x), std::abs(opposite.y)) > contract::kMaxImageSide) return {};
  return {{{b, a, glm::vec3(opposite, 0.5f)}, t.colour}};
}

TEST_F(CoverageProperties, SplittingASharedEdgeInBothNeighboursKeepsHitCounts) {
  check(grid_streams(), 300, [&](const TriangleStream& stream) {
    Verdict verdict;
    const auto split = [&](const StreamTriangle& whole, int edge, int tenths) {
      const TriangleStream before{stream.width, stream.height, {whole}},
          after{stream.width, stream.height, cut(whole, edge, tenths)};
      if (after.triangles.empty()) return;
      for_each_way([&](const Painter& painter, const lab::AblatedExecution& way, const std::string& what) {
        const Hits expected = hits(painter, snapped(before, Payload::id), stream, way);
        verdict.compare(
            hits_text(expected, hits(painter, snapped(after, Payload::id), stream, way), stream.width), what);
      });
      if (!verdict.wrong.empty() && verdict.replay.empty()) verdict.replay = {before, after};
    };
    for (const StreamTriangle& t : stream.triangles)
      for (int edge = 0; edge < 3; ++edge)
        for (const int tenths : {0, 5}) {
          split(t, edge, tenths);
          for (const StreamTriangle& other : neighbour(t, edge)) split(other, 0, 10 - tenths);
        }
    return verdict;
  });
}

TEST_F(CoverageProperties, MovingByWholePixelsKeepsHitCounts) {
  const auto moving = [&](const TriangleStream& stream) {
    Verdict verdict;
    for (const Move move : {Move{1, 0}, Move{0, 1}, Move{63, 17}, Move{5, 130}}) {
      const auto both = before_and_after(stream, move);
      const TriangleStream &before = both.first, &after = both.second;
      verdict.replay = {before, after};
      for_each_way([&](const Painter& painter, const lab::AblatedExecution& way, const std::string& what) {
        const Hits moved = hits(painter, snapped(after, Payload::id), after, way);
        verdict.compare(hits_text(hits(painter, snapped(before, Payload::id), before, way),
                                  moved_back(moved, after.width, move), stream.width),
                        text(move) + ", " + what);
      });
      if (!verdict.wrong.empty()) break;
    }
    return verdict;
  };
  check(rc::gen::oneOf(grid_streams(), float_streams()), 800, moving);
}

// ---- Not invariant: differences are counted, and must lie near edges.

// Whether a sample is within `reach` sub-units of the line of some edge.
bool near_an_edge(std::span<const ScreenTriangle> triangles, int x, int y, double reach) {
  for (const ScreenTriangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double dx = t.x_sub[j] - t.x_sub[i], dy = t.y_sub[j] - t.y_sub[i];
      const double cross =
          dx * (contract::sample_sub(y) - t.y_sub[i]) - dy * (contract::sample_sub(x) - t.x_sub[i]);
      if (std::abs(cross) <= reach * std::hypot(dx, dy)) return true;
    }
  return false;
}

struct Difference {
  std::uint64_t pixels = 0, differing = 0;

  // Empty where the counts differ within `reach` of edges only.
  std::string add(const Hits& a, const Hits& b, int width, std::span<const ScreenTriangle> triangles,
                  double reach) {
    pixels += a.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] == b[i]) continue;
      ++differing;
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      if (!near_an_edge(triangles, x, y, reach))
        return "differs away from all edges, at " + std::to_string(x) + ", " + std::to_string(y);
    }
    return {};
  }
  void record() const {
    ::testing::Test::RecordProperty("pixels", std::to_string(pixels));
    ::testing::Test::RecordProperty("differing_pixels", std::to_string(differing));
  }
};

TEST_F(CoverageProperties, MirroringChangesSamplesOnEdgesOnly) {
  Difference difference;
  check(grid_streams(), 1'000, [&](const TriangleStream& stream) {
    TriangleStream mirrored = stream;
    for (StreamTriangle& t : mirrored.triangles)
      for (glm::vec3& v : t.vertex)
        v.x = std::min(static_cast<float>(stream.width) - v.x, float{contract::kMaxImageSide});
    // As near to the guard band as a width, a vertex cannot be mirrored.
    TriangleStream original = mirrored;
    for (StreamTriangle& t : original.triangles)
      for (glm::vec3& v : t.vertex) v.x = static_cast<float>(stream.width) - v.x;
    Verdict verdict{.replay = {original, mirrored}};
    const auto triangles = snapped(original, Payload::id), changed = snapped(mirrored, Payload::id);
    for_each_way([&](const Painter& painter, const lab::AblatedExecution& way, const std::string& what) {
      Hits back = hits(painter, changed, stream, way);
      for (auto row = back.begin(); row != back.end(); row += stream.width)
        std::reverse(row, row + stream.width);
      verdict.compare(
          difference.add(hits(painter, triangles, stream, way), back, stream.width, triangles, 0.0), what);
    });
    return verdict;
  });
  difference.record();
  EXPECT_GT(difference.differing, 0u);
}

TEST_F(CoverageProperties, ClippingAtTheGuardBandChangesSamplesNearEdgesOnly) {
  constexpr double kReachSub = 1.0;
  Difference difference;
  Frontend frontend;
  check(far_streams(), 2'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    const auto whole = snapped(stream, Payload::id);
    const FrontendOptions options{stream.width, stream.height, Cull::none, false, Payload::id};
    const auto pieces = frontend.run(stream, options);
    const auto exact = covered_counts(whole, stream);
    const auto clipped = covered_counts(pieces, stream);
    verdict.compare(difference.add(exact, clipped, stream.width, whole, kReachSub), "clipped");
    for_each_way([&](const Painter& painter, const lab::AblatedExecution& way, const std::string& what) {
      verdict.compare(hits_text(clipped, hits(painter, pieces, stream, way), stream.width), what);
    });
    return verdict;
  });
  difference.record();
  EXPECT_GT(difference.differing, 0u);
}

}  // namespace
}  // namespace edgewise::testing

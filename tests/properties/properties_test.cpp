// Transformations that must not change any bit of a picture, or any hit count, of streams that are hard to
// draw.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lab/cases/backend_comparison.h"
#include "lab/truth/oracle.h"
#include "lab/truth/truth.h"
#include "properties/pictures.h"
#include "properties/streams.h"
#include "support.h"

namespace edgewise::testing {
namespace {

// ---- Moves to the right and down by whole pixels; pictures are moved back

struct Move {
  int x, y;  // px, not negative
};

std::string text(Move move) {
  return "moved by " + std::to_string(move.x) + ", " + std::to_string(move.y) + " px";
}

// A stream and its moved copy, whose image is larger by the move. Triangles that would leave the guard band
// are removed from both.
std::pair<TriangleStream, TriangleStream> before_and_after(const TriangleStream& stream, Move move) {
  std::pair<TriangleStream, TriangleStream> both{{stream.width, stream.height, {}},
                                                 {stream.width + move.x, stream.height + move.y, {}}};
  constexpr float kGuardPx = contract::kMaxImageSide;
  for (const StreamTriangle& t : stream.triangles) {
    StreamTriangle moved = t;
    for (glm::vec3& v : moved.vertex) v += glm::vec3(move.x, move.y, 0);
    if (std::any_of(moved.vertex, moved.vertex + 3,
                    [](const glm::vec3& v) { return v.x > kGuardPx || v.y > kGuardPx; }))
      continue;
    both.first.triangles.push_back(t);
    both.second.triangles.push_back(moved);
  }
  return both;
}

// Copies the part of a moved picture that was in view before the move. Rows begin every `stride` values.
void copy_moved_back(const std::uint32_t* from, std::ptrdiff_t stride, Move move, int width, int height,
                     std::uint32_t* to, std::ptrdiff_t to_stride) {
  for (int y = 0; y < height; ++y)
    std::copy_n(from + (y + move.y) * stride + move.x, width, to + y * to_stride);
}

Framebuffer moved_back(const Framebuffer& frame, Move move) {
  Framebuffer part(frame.width() - move.x, frame.height() - move.y);
  const FrameView view = part.view();
  copy_moved_back(frame.depth_row(0), frame.stride(), move, view.width, view.height, view.depth, view.stride);
  copy_moved_back(frame.payload_row(0), frame.stride(), move, view.width, view.height, view.payload,
                  view.stride);
  return part;
}

// The same for counts, row by row, of an image `width` px wide.
std::vector<std::uint32_t> moved_back(const std::vector<std::uint32_t>& counts, int width, Move move) {
  const int part_width = width - move.x, height = static_cast<int>(counts.size()) / width - move.y;
  std::vector<std::uint32_t> part(static_cast<std::size_t>(part_width) * static_cast<std::size_t>(height));
  copy_moved_back(counts.data(), width, move, part_width, height, part.data(), part_width);
  return part;
}

// ---- Pictures

class Properties : public ::testing::Test {
 protected:
  const std::vector<Painter> painters_ = painters(backends());

  // Compares each painter's pictures of `changed`, in both executions, with its scalar one of `triangles`.
  void compare_with_own(Verdict& verdict, std::span<const ScreenTriangle> triangles,
                        std::span<const ScreenTriangle> changed, const TriangleStream& stream,
                        const std::string& what) const {
    for (const Painter& painter : painters_) {
      const Framebuffer expected =
          drawn(painter, triangles, stream.width, stream.height, two_executions().front());
      compare_pictures(verdict, expected, std::span(&painter, 1), changed, two_executions(), what);
    }
  }
};

TEST_F(Properties, EveryBackendMatchesTheOracleInEveryExecution) {
  check(grid_streams(), 1'500, like_the_oracles(painters_, executions()));
}

TriangleStream on_grid(const TriangleStream& stream) {
  TriangleStream result = stream;
  for (StreamTriangle& t : result.triangles)
    for (glm::vec3& v : t.vertex)
      for (const int axis : {0, 1})
        v[axis] = static_cast<float>(snapped_to_grid(v[axis])) / contract::kPixel_q15;
  return result;
}

TEST_F(Properties, VerticesOffTheGridAreSnappedHalfToEven) {
  Frontend frontend;
  check(float_streams(), 2'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream, on_grid(stream)}};
    const FrontendOptions options{stream.width, stream.height, Cull::none, false, Payload::id};
    const auto triangles = snapped(stream, Payload::id);
    Framebuffer expected(stream.width, stream.height);
    lab::draw_oracle(triangles, expected, kBackground);
    for (const SimdTarget target : supported_targets())
      compare_pictures(verdict, expected, painters_, frontend.run(stream, options, {.target = target}),
                       two_executions(), "front end, " + std::string(name_of(target)));
    return verdict;
  });
}

StreamTriangle reordered(const StreamTriangle& t, const std::array<int, 3>& order) {
  return {{t.vertex[order[0]], t.vertex[order[1]], t.vertex[order[2]]}, t.colour};
}

TEST_F(Properties, RotatingOrReversingTheVertexOrderChangesNothing) {
  constexpr std::array<std::array<int, 3>, 5> kOrders{
      {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  check(grid_streams(), 1'500, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    for (std::size_t order = 0; order <= kOrders.size(); ++order) {
      TriangleStream changed = stream;
      for (std::size_t i = 0; i < changed.triangles.size(); ++i)  // finally, each triangle differently
        changed.triangles[i] =
            reordered(stream.triangles[i], kOrders[order == kOrders.size() ? i % order : order]);
      compare_with_own(verdict, snapped(stream, Payload::id), snapped(changed, Payload::id), stream,
                       "vertices in another order");
      if (!verdict.wrong.empty()) {
        verdict.replay.push_back(changed);
        break;
      }
    }
    return verdict;
  });
}

TEST_F(Properties, TrianglesWithoutAreaChangeNothing) {
  check(grid_streams(), 2'000, [&](const TriangleStream& stream) {
    TriangleStream more{stream.width, stream.height, {}};
    for (const StreamTriangle& t : stream.triangles) {
      const auto& [a, b, c] = t.vertex;
      more.triangles.push_back({{a, a, b}, 1});
      more.triangles.push_back(t);
      more.triangles.push_back({{b, c, b}, 2});
      more.triangles.push_back({{c, c, c}, 3});
    }
    Verdict verdict{.replay = {stream, more}};
    const auto triangles = snapped(stream, Payload::colour);
    auto without = triangles;
    std::erase_if(without, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
    compare_with_own(verdict, triangles, without, stream, "without triangles that have no area");
    compare_with_own(verdict, triangles, snapped(more, Payload::colour), stream,
                     "with more triangles that have no area");
    return verdict;
  });
}

TEST_F(Properties, MovingByMultiplesOf64PixelsChangesNothing) {  // the cell of depth, rule 6
  check(grid_streams(), 1'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {}};
    for (const Move move : {Move{64, 0}, Move{0, 64}, Move{192, 128}}) {
      const auto [before, after] = before_and_after(stream, move);
      verdict.replay = {before, after};
      const auto triangles = snapped(before, Payload::id), moved = snapped(after, Payload::id);
      for (const Painter& painter : painters_)
        for (const lab::DrawOptions& way : two_executions())
          verdict.compare(
              difference_text(drawn(painter, triangles, before.width, before.height, way),
                              moved_back(drawn(painter, moved, after.width, after.height, way), move)),
              text(move) + ", " + std::string(painter.name) + ", " + describe(way));
      if (!verdict.wrong.empty()) break;
    }
    return verdict;
  });
}

// ---- Hit counts: each triangle is drawn without occlusion by the others

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
                   const TriangleStream& stream, const lab::DrawOptions& way) {
    return lab::count_hits(painter.with({}), triangles, stream.width, stream.height, way.execution);
  }

  template <typename Judge>
  void for_each_way(Judge&& judge) const {
    for (const Painter& painter : painters_)
      for (const lab::DrawOptions& way : two_executions())
        judge(painter, way, std::string(painter.name) + ", " + describe(way));
  }
};

TEST_F(CoverageProperties, EveryPointOfATessellatedPlaneIsCoveredOnce) {
  check(tessellations(), 3'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    const auto triangles = snapped(stream, Payload::id);
    const Hits once(static_cast<std::size_t>(stream.width * stream.height), 1);
    verdict.compare(hits_text(once, covered_counts(triangles, stream), stream.width), "the exact truth");
    for_each_way([&](const Painter& painter, const lab::DrawOptions& way, const std::string& what) {
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
      for_each_way([&](const Painter& painter, const lab::DrawOptions& way, const std::string& what) {
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
      for_each_way([&](const Painter& painter, const lab::DrawOptions& way, const std::string& what) {
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

// Whether a sample is within `reach` 2^-15 px of the line of some edge.
bool near_an_edge(std::span<const ScreenTriangle> triangles, int x, int y, double reach) {
  for (const ScreenTriangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double dx = t.x_q15[j] - t.x_q15[i], dy = t.y_q15[j] - t.y_q15[i];
      const double cross =
          dx * (contract::sample_q15(y) - t.y_q15[i]) - dy * (contract::sample_q15(x) - t.x_q15[i]);
      if (std::abs(cross) <= reach * std::hypot(dx, dy)) return true;
    }
  return false;
}

TEST_F(CoverageProperties, ClippingAtTheGuardBandChangesSamplesNearEdgesOnly) {
  constexpr double kReach_q15 = 1 << Coarse::kSpareBits;
  Frontend frontend;
  std::uint64_t differing = 0;
  check(far_streams(), 2'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream}};
    const auto whole = snapped(stream, Payload::id);
    const FrontendOptions options{stream.width, stream.height, Cull::none, false, Payload::id};
    const auto pieces = frontend.run(stream, options);
    const auto exact = covered_counts(whole, stream);
    const auto clipped = covered_counts(pieces, stream);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (exact[i] == clipped[i]) continue;
      ++differing;
      const int x = static_cast<int>(i) % stream.width, y = static_cast<int>(i) / stream.width;
      verdict.compare(near_an_edge(whole, x, y, kReach_q15) ? "" : "differs away from all edges", "clipped");
    }
    for_each_way([&](const Painter& painter, const lab::DrawOptions& way, const std::string& what) {
      verdict.compare(hits_text(clipped, hits(painter, pieces, stream, way), stream.width), what);
    });
    return verdict;
  });
  EXPECT_GT(differing, 0u);
}

}  // namespace
}  // namespace edgewise::testing

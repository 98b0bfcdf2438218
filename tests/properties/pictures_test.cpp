// Transformations that must not change any bit of a picture, on streams that are hard to draw.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lab/oracle.h"
#include "lab/truth.h"
#include "properties/move.h"
#include "properties/pictures.h"
#include "properties/streams.h"
#include "support.h"

namespace edgewise::testing {
namespace {

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
      for (const int axis : {0, 1}) v[axis] = static_cast<float>(snapped_to_grid(v[axis])) / contract::kSub;
  return result;
}

TEST_F(Properties, VerticesOffTheGridAreSnappedHalfToEven) {
  Frontend frontend;
  check(float_streams(), 2'000, [&](const TriangleStream& stream) {
    Verdict verdict{.replay = {stream, on_grid(stream)}, .replay_by_pictures = true};
    FrontendOptions options{stream.width, stream.height, Cull::none, false, Payload::id};
    const auto triangles = snapped(stream, Payload::id);
    Framebuffer expected(stream.width, stream.height);
    lab::draw_oracle(triangles, expected, kBackground);
    for (const SimdTarget target : supported_targets()) {
      options.target = target;
      compare_pictures(verdict, expected, painters_, frontend.run(stream, options), two_executions(),
                       "front end, " + std::string(name_of(target)));
    }
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
    Verdict verdict{.replay = {stream}, .replay_by_pictures = true};
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
    Verdict verdict{.replay = {stream, more}, .replay_by_pictures = true};
    const auto triangles = snapped(stream, Payload::colour);
    auto without = triangles;
    std::erase_if(without, [](const ScreenTriangle& t) { return contract::signed_area(t) == 0; });
    compare_with_own(verdict, triangles, without, stream, "without triangles that have no area");
    compare_with_own(verdict, triangles, snapped(more, Payload::colour), stream,
                     "with more triangles that have no area");
    return verdict;
  });
}

TEST_F(Properties, DepthTiesKeepTheEarlierTriangle) {
  check(grid_streams(), 2'000, [&](const TriangleStream& stream) {
    TriangleStream twice = stream;
    for (const StreamTriangle& t : stream.triangles) twice.triangles.push_back(reordered(t, {2, 1, 0}));
    Verdict verdict{.replay = {stream, twice}, .replay_by_pictures = true};
    compare_with_own(verdict, snapped(stream, Payload::id), snapped(twice, Payload::id), stream,
                     "followed by a copy");
    return verdict;
  });
}

TEST_F(Properties, EqualDepthsKeepTheFirstTriangleOfEachPixel) {
  check(grid_streams(), 500, [&](const TriangleStream& stream) {
    TriangleStream flat = stream;
    for (StreamTriangle& t : flat.triangles)
      for (glm::vec3& v : t.vertex) v.z = 0.5f;
    Verdict verdict{.replay = {flat}};
    const auto triangles = snapped(flat, Payload::id);
    std::vector<lab::SnappedTruth> truths(triangles.begin(), triangles.end());
    for (const Painter& painter : painters_)
      for (const lab::AblatedExecution& way : two_executions()) {
        const Framebuffer frame = drawn(painter, triangles, flat.width, flat.height, way);
        int wrong = 0;
        for (int y = 0; y < flat.height; ++y)
          for (int x = 0; x < flat.width; ++x) {
            const auto first = std::find_if(truths.begin(), truths.end(),
                                            [&](const lab::SnappedTruth& t) { return t.covers(x, y); });
            const auto id = static_cast<std::uint32_t>(first - truths.begin());
            wrong += frame.payload_row(y)[x] != (first == truths.end() ? kBackground : id);
          }
        verdict.compare(wrong == 0 ? "" : std::to_string(wrong) + " pixels not of the first",
                        std::string(painter.name) + ", " + describe(way));
      }
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
        for (const lab::AblatedExecution& way : two_executions())
          verdict.compare(
              difference_text(drawn(painter, triangles, before.width, before.height, way),
                              moved_back(drawn(painter, moved, after.width, after.height, way), move)),
              text(move) + ", " + std::string(painter.name) + ", " + describe(way));
      if (!verdict.wrong.empty()) break;
    }
    return verdict;
  });
}

// Empty if both show the same payloads, and depths that differ by no more than rule 6 allows.
std::string difference_beyond_rounding(const Framebuffer& a, const Framebuffer& b) {
  int payloads = 0, depths = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const auto off = std::int64_t{a.depth_row(y)[x]} - std::int64_t{b.depth_row(y)[x]};
      payloads += a.payload_row(y)[x] != b.payload_row(y)[x];
      depths += std::abs(off) >= 2 * std::int64_t{contract::kDepthError};
    }
  if (payloads + depths == 0) return "";
  return std::to_string(payloads) + " payloads and " + std::to_string(depths) + " depths differ";
}

TEST_F(Properties, MovingByWholePixelsKeepsSamplesAndBoundsTheDepthChange) {
  check(grid_streams(), 100, [&](const TriangleStream& stream) {
    Verdict verdict;
    for (const Move move : {Move{1, 0}, Move{0, 63}, Move{29, 101}}) {
      const auto [before, after] = before_and_after(stream, move);
      verdict.replay = {before, after};
      const auto triangles = snapped(before, Payload::id), moved = snapped(after, Payload::id);
      for (const Painter& painter : painters_)
        for (std::size_t i = 0; i < triangles.size(); ++i) {
          const lab::AblatedExecution& way = two_executions().back();
          const auto here = drawn(painter, std::span(&triangles[i], 1), before.width, before.height, way);
          const auto there = drawn(painter, std::span(&moved[i], 1), after.width, after.height, way);
          verdict.compare(difference_beyond_rounding(here, moved_back(there, move)),
                          text(move) + ", " + std::string(painter.name) + ", triangle " + std::to_string(i));
        }
      if (!verdict.wrong.empty()) break;
    }
    return verdict;
  });
}

}  // namespace
}  // namespace edgewise::testing

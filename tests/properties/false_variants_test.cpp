// Tests the property search itself with deliberately wrong backends: it must find each mistake and reduce it
// to a very small .tri file that reproduces it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "cli/verify/verify.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "properties/pictures.h"
#include "properties/property.h"
#include "properties/streams.h"
#include "temp_dir.h"

namespace edgewise::testing {
namespace {

// ---- Deliberately wrong backends

enum class Mistake { samples_on_all_edges_are_inside, later_wins_a_tie, one_lane_is_a_unit_deeper };

template <Mistake kMistake>
class Mistaken : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, const FramePart& part,
                    const Execution& execution) override {
    const FrameView& frame = part.frame;
    right_->draw({}, frame, {part.background}, execution);
    for (const ScreenTriangle& triangle : triangles) {
      const contract::Oriented t = contract::orient(triangle);
      if (t.area == 0) continue;
      contract::Edge edges[3] = {contract::make_edge(t, 0), contract::make_edge(t, 1),
                                 contract::make_edge(t, 2)};
      if (kMistake == Mistake::samples_on_all_edges_are_inside)
        for (contract::Edge& edge : edges)
          if (!contract::is_top_left(edge.a, edge.b)) ++edge.c;
      const contract::DepthPlane plane = contract::make_depth(t);
      // The box holds every sample that the triangle touches, since some variants cover too many samples.
      const auto [min_x, max_x] = std::minmax({t.x[0], t.x[1], t.x[2]});
      const auto [min_y, max_y] = std::minmax({t.y[0], t.y[1], t.y[2]});
      for (int y = std::max(min_y / contract::kPixel_q15, 0);
           y <= std::min(max_y / contract::kPixel_q15, frame.height - 1); ++y)
        for (int x = std::max(min_x / contract::kPixel_q15, 0);
             x <= std::min(max_x / contract::kPixel_q15, frame.width - 1); ++x) {
          if (edges[0].at(x, y) < 0 || edges[1].at(x, y) < 0 || edges[2].at(x, y) < 0) continue;
          std::uint32_t z = plane.at(x, y);
          if (kMistake == Mistake::one_lane_is_a_unit_deeper && x % 8 == 5) ++z;
          std::uint32_t& old = frame.depth[y * frame.stride + x];
          if (kMistake == Mistake::later_wins_a_tie ? z > old : z >= old) continue;
          old = z;
          frame.payload[y * frame.stride + x] = triangle.payload;
        }
    }
  }
  std::unique_ptr<Backend> right_ = backends()[0].make();
};

template <Mistake kMistake>
BackendInfo mistaken() {
  return {"wrong", "a wrong backend",
          [] { return std::unique_ptr<Backend>(std::make_unique<Mistaken<kMistake>>()); }};
}

struct Variant {
  BackendInfo wrong;
  std::size_t triangles;  // the number needed to show the mistake
};

TEST(WrongBackend, IsFoundAndReducedToASmallStreamThatReproducesIt) {
  const Variant variants[] = {{mistaken<Mistake::samples_on_all_edges_are_inside>(), 1},
                              {mistaken<Mistake::later_wins_a_tie>(), 2},
                              {mistaken<Mistake::one_lane_is_a_unit_deeper>(), 1}};
  for (const Variant& variant : variants) {
    SCOPED_TRACE(&variant - variants);
    const auto wrong = painters(std::span(&variant.wrong, 1));
    const SearchResult result = search(grid_streams(), 300, like_the_oracles(wrong, {lab::DrawOptions{}}));
    ASSERT_TRUE(result.found.has_value());
    const TriangleStream& smallest = result.found->verdict.replay.at(0);
    EXPECT_EQ(smallest.triangles.size(), variant.triangles);
    EXPECT_LE(smallest.width * smallest.height, 8);

    const TempDir folder;
    const std::string message = report(*result.found, folder.path(), "wrong"),
                      path = (folder.path() / "wrong.tri").string();
    EXPECT_NE(message.find("'" EDGEWISE_PROGRAM "' verify '" + path + "'"), std::string::npos) << message;
    tools::VerifyPlan plan;
    plan.scenes = {path};
    plan.backends = {backends()[0], variant.wrong};
    const tools::SceneVerdict verdict = tools::verify(plan, {}).scenes.at(0);
    EXPECT_GT(verdict.differing_pixels, 0u);
    EXPECT_GT(verdict.oracle_differences, 0u);
  }
}

}  // namespace
}  // namespace edgewise::testing

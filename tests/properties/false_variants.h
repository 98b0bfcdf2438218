// Deliberately wrong backends.
#pragma once

#include <algorithm>
#include <memory>

#include "edgewise/backend.h"
#include "edgewise/contract.h"

namespace edgewise::testing {

enum class Mistake { samples_on_all_edges_are_inside, later_wins_a_tie, one_lane_is_a_unit_deeper };

template <Mistake kMistake>
class Mistaken : public Backend {
  void draw_checked(std::span<const ScreenTriangle> triangles, FrameView frame, std::uint32_t background,
                    const Execution& execution) override {
    right_->draw({}, frame, background, execution);
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
      for (int y = std::max(min_y / contract::kSub, 0);
           y <= std::min(max_y / contract::kSub, frame.height - 1); ++y)
        for (int x = std::max(min_x / contract::kSub, 0);
             x <= std::min(max_x / contract::kSub, frame.width - 1); ++x) {
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

}  // namespace edgewise::testing

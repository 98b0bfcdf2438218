// Changes of triangle lists that must not change any bit of a picture, or any hit count. They follow from the
// contract, and need no oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support.h"

namespace edgewise::testing {
namespace {

using Triangles = std::vector<ScreenTriangle>;

// Of each family of hard triangles.
class Properties : public ::testing::TestWithParam<std::string_view> {
 protected:
  // Calls check(triangles, width, height) for random lists, until one fails.
  template <typename Check>
  void for_each_list(Check&& check) {
    const std::uint64_t lists = full_size() ? 1'000 : 40;
    for (std::uint64_t seed = 0; seed < lists && !HasFailure(); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const int width = between(random, 1, 130), height = between(random, 1, 130);
      const int count = between(random, 1, 30);
      check(adversarial(GetParam(), count, width, height, random.next()), width, height);
    }
    RecordProperty("cases", std::to_string(lists));
    RecordProperty("comparisons", std::to_string(comparisons_));
  }

  // Calls check(backend, execution, description) for each backend, in scalar code and with the best target.
  template <typename Check>
  void for_each_way(Check&& check) {
    for (const BackendInfo& info : backends())
      for (const SimdTarget target : {SimdTarget::scalar, SimdTarget::best}) {
        const Execution execution{1, 64, target};
        check(backends_.get(info, {}), execution, std::string(info.name) + ", " + describe(execution));
        ++comparisons_;
      }
  }

  static Framebuffer drawn(Backend& backend, const Triangles& triangles, int width, int height,
                           const Execution& execution) {
    Framebuffer frame(width, height);
    lab::poison(frame);
    backend.draw(triangles, frame.view(), {kBackground}, execution);
    return frame;
  }

  void expect_same_pictures(const Triangles& before, const Triangles& after, int width, int height) {
    for_each_way([&](Backend& backend, const Execution& execution, const std::string& what) {
      expect_same(drawn(backend, before, width, height, {.target = SimdTarget::scalar}),
                  drawn(backend, after, width, height, execution), what);
    });
  }

 private:
  lab::BackendCache backends_;
  std::uint64_t comparisons_ = 0;
};

TEST_P(Properties, RotatingOrReversingTheVertexOrderChangesNothing) {
  constexpr std::array<std::array<int, 3>, 5> kOrders{
      {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for_each_list([&](const Triangles& triangles, int width, int height) {
    for (std::size_t order = 0; order <= kOrders.size(); ++order) {
      Triangles changed = triangles;
      for (std::size_t i = 0; i < changed.size(); ++i)
        for (int k = 0; k < 3; ++k) {  // finally, each triangle differently
          const ScreenTriangle& from = triangles[i];
          const auto at = kOrders[order == kOrders.size() ? i % order : order][static_cast<std::size_t>(k)];
          changed[i].x_q15[k] = from.x_q15[at], changed[i].y_q15[k] = from.y_q15[at];
          changed[i].z[k] = from.z[at];
        }
      expect_same_pictures(triangles, changed, width, height);
    }
  });
}

struct Move {
  int x, y;  // px, not negative
};

// The triangles that stay in the guard band, before and after the move.
std::pair<Triangles, Triangles> before_and_after(const Triangles& triangles, const Move& move) {
  std::pair<Triangles, Triangles> both;
  for (const ScreenTriangle& t : triangles) {
    ScreenTriangle moved = t;
    for (std::int32_t& x : moved.x_q15) x += move.x * contract::kPixel_q15;
    for (std::int32_t& y : moved.y_q15) y += move.y * contract::kPixel_q15;
    if (std::max({*std::ranges::max_element(moved.x_q15), *std::ranges::max_element(moved.y_q15)}) >
        contract::kGuard_q15)
      continue;
    both.first.push_back(t), both.second.push_back(moved);
  }
  return both;
}

// By multiples of 64 px, which is the cell of depth (rule 6); and by any whole pixels if all planes are
// level.
TEST_P(Properties, MovingByWholePixelsChangesNothing) {
  for_each_list([&](const Triangles& triangles, int width, int height) {
    Triangles level = triangles;
    for (ScreenTriangle& t : level) t.z[1] = t.z[2] = t.z[0];
    for (const Move move : {Move{64, 0}, {0, 64}, {192, 128}, {1, 0}, {0, 1}, {63, 17}, {5, 130}}) {
      const bool by_cells = move.x % 64 == 0 && move.y % 64 == 0;
      const auto both = before_and_after(by_cells ? triangles : level, move);
      const Triangles &before = both.first, &after = both.second;
      for_each_way([&](Backend& backend, const Execution& execution, const std::string& what) {
        const Framebuffer moved = drawn(backend, after, width + move.x, height + move.y, execution);
        Framebuffer back(width, height);
        const FrameView view = back.view();
        for (int y = 0; y < height; ++y) {  // the part that was in view before the move
          std::copy_n(moved.depth_row(y + move.y) + move.x, width, view.depth + y * view.stride);
          std::copy_n(moved.payload_row(y + move.y) + move.x, width, view.payload + y * view.stride);
        }
        expect_same(drawn(backend, before, width, height, execution), back, what);
      });
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, Properties, ::testing::ValuesIn(kFamilies),
                         [](const auto& param) { return test_name(param); });

}  // namespace
}  // namespace edgewise::testing

// What a RenderPass states, for every backend in every execution: draws add up, a scissor crops the picture,
// and depth can be drawn alone.
#include <algorithm>
#include <limits>

#include "every_backend.h"
#include "lab/cases/guarded_frame.h"
#include "message_of.h"

namespace edgewise {
namespace {

using namespace contract;
using lab::GuardedFrame;
using testing::EveryBackend;
using testing::kBackground;

constexpr std::uint32_t kUnseen = 0x5EED;  // the background of draws that do not clear

// Triangles of a family, many of them at one depth, and copies of them at random places. Of equal ones only
// the payloads differ.
std::vector<ScreenTriangle> with_ties(std::string_view family, int count, int width, int height,
                                      std::uint64_t seed) {
  Random random(seed);
  std::vector<ScreenTriangle> triangles = testing::adversarial(family, count, width, height, seed);
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    std::fill_n(triangles[i].z, 3, kDepthHead + kDepthRange / 2);
  for (int i = 0; i < count / 2; ++i) {
    ScreenTriangle copy = triangles[random.below(triangles.size())];
    copy.payload = static_cast<std::uint32_t>(1000 + i);
    triangles.insert(triangles.begin() + static_cast<std::ptrdiff_t>(random.below(triangles.size() + 1)),
                     copy);
  }
  return triangles;
}

// Odd layouts rule out aligned stores.
GuardedFrame frame_of(int width, int height, bool aligned) {
  return {width, height,
          aligned ? GuardedFrame::aligned(width) : GuardedFrame::Layout{.padding = 5, .offset = 3}};
}

void expect_drawn(const Framebuffer& expected, const GuardedFrame& found, const std::string& what) {
  testing::expect_same(expected, found.copy(), what);
  EXPECT_EQ(found.written_outside(), 0u) << what;
}

bool holds(const PixelRect& rect, int x, int y) {
  return x >= rect.x && y >= rect.y && std::int64_t{x} - rect.x < rect.width &&
         std::int64_t{y} - rect.y < rect.height;
}

// `inside` where the rectangle is, `outside` elsewhere.
Framebuffer composed(const Framebuffer& inside, const PixelRect& rect, const Framebuffer& outside) {
  Framebuffer frame(inside.width(), inside.height());
  const FrameView view = frame.view();
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const Framebuffer& from = holds(rect, x, y) ? inside : outside;
      view.depth[y * view.stride + x] = from.depth_row(y)[x];
      view.payload[y * view.stride + x] = from.payload_row(y)[x];
    }
  return frame;
}

// The depths, with canaries for payloads.
Framebuffer depths_of(const Framebuffer& frame) {
  Framebuffer depths(frame.width(), frame.height());
  lab::poison(depths);
  for (int y = 0; y < frame.height(); ++y)
    std::copy_n(frame.depth_row(y), frame.width(), depths.view().depth + y * depths.stride());
  return depths;
}

FrameView without_payload(FrameView view) {
  view.payload = nullptr;
  return view;
}

// One draw of a whole frame.
Framebuffer whole(Backend& backend, std::span<const ScreenTriangle> triangles, int width, int height) {
  Framebuffer frame(width, height);
  backend.draw(triangles, frame.view(), {kBackground});
  return frame;
}

TEST_P(EveryBackend, SeveralDrawsEqualOneOfAll) {
  const std::vector<std::string_view> all(testing::kFamilies.begin(), testing::kFamilies.end());
  struct Case {
    int width, height, count;  // px; triangles
    std::size_t most;          // triangles in a draw; some have none
    std::vector<std::string_view> families;
  };
  const Case cases[] = {{1, 1, 40, 60, all},
                        {15, 17, 40, 60, all},
                        {63, 65, 40, 60, all},
                        {200, 130, 40, 60, all},
                        {97, 71, 20, 1, {"uniform", "cloud"}},
                        {150, 90, 8'000, 9'000, {"cloud"}}};  // several slices and segments in each draw
  Random random(1);
  for (const auto& [width, height, count, most, families] : cases)
    for (const auto family : families) {
      const auto triangles = with_ties(family, count, width, height, random.next());
      const Framebuffer expected = whole(*backend_, triangles, width, height);
      GuardedFrame frame = frame_of(width, height, random.below(2) == 0);
      for (const auto& how : testing::executions()) {
        frame.poison();
        Backend& backend = backends_.get(info_, how.tiles);
        RenderPass pass{kBackground};
        for (std::span rest(triangles); !rest.empty(); pass = {.background = kUnseen, .clear = false}) {
          const std::size_t n = random.below(std::min(most, rest.size()) + 1);
          backend.draw(rest.first(n), frame.view(), pass, how.execution);
          rest = rest.subspan(n);
        }
        expect_drawn(expected, frame, std::string(family) + ", " + testing::describe(how));
      }
    }
}

// Rectangles inside, around, beside and partly beside the image; on the sides of tiles and next to them.
std::vector<PixelRect> scissors(int width, int height) {
  constexpr int kMost = std::numeric_limits<int>::max(), kLeast = std::numeric_limits<int>::min();
  std::vector<PixelRect> list{{},
                              {0, 0, width, height},
                              {0, 0, 1, 1},
                              {width - 1, height - 1, 1, 1},
                              {-5, -7, width, height},
                              {-3, 50, width + 9, 1},
                              {70, -3, 1, height + 9},
                              {kLeast, kLeast, kMost, kMost},
                              {20, 30, kMost, kMost},
                              {-5, 3, 4, 4},
                              {width, 0, 9, 9},
                              {3, height, 9, 9},
                              {kMost, kMost, kMost, kMost},
                              {30, 30, 0, 5}};
  for (const int side : {16, 32, 64})
    for (const int beside : {-1, 0, 1}) list.push_back({side + beside, side - beside, side, side / 2 + 1});
  Random random(8);
  for (int i = 0; i < 8; ++i)
    list.push_back({testing::between(random, -20, width), testing::between(random, -20, height),
                    testing::between(random, 1, width), testing::between(random, 1, height)});
  return list;
}

TEST_P(EveryBackend, AScissorCropsThePicture) {
  constexpr int kWidth = 150, kHeight = 101;
  std::uint64_t seed = 0;
  for (const PixelRect& scissor : scissors(kWidth, kHeight)) {
    const auto family = testing::kFamilies[++seed % testing::kFamilies.size()];
    auto triangles = with_ties(family, 60, kWidth, kHeight, seed);
    const auto small = testing::adversarial("cloud", 300, kWidth, kHeight, seed);
    triangles.insert(triangles.end(), small.begin(), small.end());
    const auto first = std::span(triangles).first(40), rest = std::span(triangles).subspan(40);
    GuardedFrame frame = frame_of(kWidth, kHeight, seed % 2 == 0);
    const Framebuffer blank = GuardedFrame(kWidth, kHeight, {}).copy();
    const Framebuffer before = whole(*backend_, first, kWidth, kHeight);
    const Framebuffer cleared = composed(whole(*backend_, rest, kWidth, kHeight), scissor, blank);
    const Framebuffer added = composed(whole(*backend_, triangles, kWidth, kHeight), scissor, before);
    const Framebuffer added_depths = depths_of(added);
    const std::string where = std::string(family) + ", scissor " + std::to_string(scissor.x) + ", " +
                              std::to_string(scissor.y) + ", " + std::to_string(scissor.width) + " x " +
                              std::to_string(scissor.height) + ", ";
    for (const auto& how : testing::executions()) {
      Backend& backend = backends_.get(info_, how.tiles);
      const auto draw_after = [&](FrameView view, const RenderPass& pass) {
        backend.draw(first, view, {kBackground}, how.execution);
        backend.draw(rest, view, pass, how.execution);
      };
      const std::string what = where + testing::describe(how);
      frame.poison();
      backend.draw(rest, frame.view(), {.background = kBackground, .scissor = scissor}, how.execution);
      expect_drawn(cleared, frame, what);
      frame.poison();
      draw_after(frame.view(), {.background = kUnseen, .clear = false, .scissor = scissor});
      expect_drawn(added, frame, what + ", added");
      frame.poison();
      draw_after(without_payload(frame.view()), {.clear = false, .scissor = scissor});
      expect_drawn(added_depths, frame, what + ", added, depth only");
    }
  }
}

TEST_P(EveryBackend, RefusesAScissorOfNegativeSize) {
  GuardedFrame frame = frame_of(8, 8, true);
  for (const PixelRect& scissor : {PixelRect{0, 0, -1, 8}, {0, 0, 8, -1}})
    EXPECT_EQ(message_of([&] { backend_->draw({}, frame.view(), {.scissor = scissor}); }),
              "scissor of " + std::to_string(scissor.width) + " x " + std::to_string(scissor.height) +
                  " px has a negative side");
  expect_drawn(GuardedFrame(8, 8, {}).copy(), frame, "unchanged");
}

}  // namespace
}  // namespace edgewise

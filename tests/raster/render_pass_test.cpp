// What a RenderPass states, for every backend in every execution: draws add up, a scissor crops the picture,
// and depth can be drawn alone.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "edgewise/draw.h"
#include "edgewise/visible.h"
#include "every_backend.h"
#include "lab/cases/guarded_frame.h"
#include "lab/cases/random_cases.h"
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

TEST_P(EveryBackend, TwoDrawsEqualOneOfBoth) {
  Random random(1);
  bool aligned = false;
  for (const auto& [width, height] : {std::pair{1, 1}, {15, 17}, {63, 65}, {97, 71}, {200, 130}})
    for (const auto family : testing::kFamilies) {
      const auto triangles = with_ties(family, 40, width, height, random.next());
      const Framebuffer expected = whole(*backend_, triangles, width, height);
      const std::size_t cut = random.below(triangles.size() + 1);
      const auto first = std::span(triangles).first(cut), rest = std::span(triangles).subspan(cut);
      GuardedFrame frame = frame_of(width, height, aligned = !aligned);
      for (const auto& how : testing::executions()) {
        frame.poison();
        Backend& backend = backends_.get(info_, how.tiles);
        backend.draw(first, frame.view(), {kBackground}, how.execution);
        backend.draw(rest, frame.view(), {.background = kUnseen, .clear = false}, how.execution);
        expect_drawn(expected, frame,
                     std::string(family) + ", " + std::to_string(cut) + " first, " + testing::describe(how));
      }
    }
}

TEST_P(EveryBackend, DrawsOfOneTriangleEachEqualOneOfAll) {
  constexpr int kWidth = 97, kHeight = 71;
  for (const auto family : {"uniform", "cloud"}) {
    const auto triangles = with_ties(family, 20, kWidth, kHeight, 3);
    const Framebuffer expected = whole(*backend_, triangles, kWidth, kHeight);
    for (const auto& how : testing::executions()) {
      Framebuffer frame(kWidth, kHeight);
      Backend& backend = backends_.get(info_, how.tiles);
      backend.draw({}, frame.view(), {kBackground}, how.execution);
      for (const ScreenTriangle& triangle : triangles)
        backend.draw({&triangle, 1}, frame.view(), {.clear = false}, how.execution);
      testing::expect_same(expected, frame, std::string(family) + ", " + testing::describe(how));
    }
  }
}

TriangleStream joined(const TriangleStream& a, const TriangleStream& b) {
  TriangleStream both = a;
  both.triangles.insert(both.triangles.end(), b.triangles.begin(), b.triangles.end());
  return both;
}
// Seen by the camera of the first.
Scene joined(const Scene& a, const Scene& b) {
  Scene both = a;
  both.meshes.insert(both.meshes.end(), b.meshes.begin(), b.meshes.end());
  both.instances.insert(both.instances.end(), b.instances.begin(), b.instances.end());
  for (Instance& instance : std::span(both.instances).subspan(a.instances.size()))
    instance.mesh += a.meshes.size();
  return both;
}
std::size_t triangles_of(const TriangleStream& stream) {
  return stream.triangles.size();
}
std::size_t triangles_of(const Scene& scene) {
  return first_ids(scene).back();
}

TEST_P(EveryBackend, TwoDrawsOfDrawablesEqualOneOfBothIdsIncluded) {
  constexpr int kWidth = 97, kHeight = 71;
  Frontend frontend;
  const auto expect_added = [&]<typename T>(const T& first, T second, const std::string& what) {
    if constexpr (std::is_same_v<T, Scene>) second.camera = first.camera;
    FrontendOptions options{.width = kWidth, .height = kHeight, .cull = Cull::none, .payload = Payload::id};
    Framebuffer expected(kWidth, kHeight), frame(kWidth, kHeight);
    draw(joined(first, second), frontend, options, *backend_, expected.view(), {kBackground});
    for (const auto& how : testing::executions()) {
      lab::poison(frame);
      Backend& backend = backends_.get(info_, how.tiles);
      options.first_id = 0;
      draw(first, frontend, options, backend, frame.view(), {kBackground}, how.execution);
      options.first_id = static_cast<std::uint32_t>(triangles_of(first));
      draw(second, frontend, options, backend, frame.view(), RenderPass{.clear = false}, how.execution);
      testing::expect_same(expected, frame, what + ", " + testing::describe(how));
    }
  };
  const auto families = randomized::scene_families();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const auto make = [&](std::size_t family) { return families[family].make(random, kWidth, kHeight); };
    const Drawable a = make(seed % families.size()), b = make(seed % families.size());
    std::visit([&]<typename T>(const T& first) { expect_added(first, std::get<T>(b), std::to_string(seed)); },
               a);
  }
}

// Several slices and segments in each draw.
TEST_P(EveryBackend, TwoDrawsOfManyTrianglesEqualOneOfBoth) {
  constexpr int kWidth = 150, kHeight = 90;
  const auto triangles = with_ties("cloud", 8'000, kWidth, kHeight, 4);
  const Framebuffer expected = whole(*backend_, triangles, kWidth, kHeight);
  for (const auto& how : testing::executions()) {
    Framebuffer frame(kWidth, kHeight);
    Backend& backend = backends_.get(info_, how.tiles);
    backend.draw(std::span(triangles).first(5'000), frame.view(), {kBackground}, how.execution);
    backend.draw(std::span(triangles).subspan(5'000), frame.view(), {.clear = false}, how.execution);
    testing::expect_same(expected, frame, testing::describe(how));
  }
}

TEST_P(EveryBackend, ADrawOfNothingThatDoesNotClearWritesNothing) {
  GuardedFrame frame = frame_of(150, 90, true);
  for (const auto& how : testing::executions()) {
    backends_.get(info_, how.tiles).draw({}, frame.view(), {.clear = false}, how.execution);
    expect_drawn(GuardedFrame(150, 90, {}).copy(), frame, testing::describe(how));
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

TEST_P(EveryBackend, DepthAloneIsThatOfTheWholePicture) {
  for (const auto& [width, height] : {std::pair{1, 1}, {15, 17}, {63, 65}, {150, 101}})
    for (const auto family : {"uniform", "cloud", "huge"}) {
      const auto triangles = with_ties(family, 50, width, height, 6);
      const Framebuffer expected = depths_of(whole(*backend_, triangles, width, height));
      GuardedFrame frame = frame_of(width, height, width % 2 == 0);
      for (const auto& how : testing::executions()) {
        frame.poison();
        backends_.get(info_, how.tiles)
            .draw(triangles, without_payload(frame.view()), {kBackground}, how.execution);
        expect_drawn(expected, frame, std::string(family) + ", " + testing::describe(how));
      }
    }
}

TEST_P(EveryBackend, RefusesAScissorOfNegativeSize) {
  GuardedFrame frame = frame_of(8, 8, true);
  const auto draw_in = [&](const PixelRect& scissor) {
    backend_->draw({}, frame.view(), {.scissor = scissor});
  };
  EXPECT_EQ(message_of([&] { draw_in({0, 0, -1, 8}); }), "scissor of -1 x 8 px has a negative side");
  EXPECT_THROW(draw_in({0, 0, 8, -1}), std::invalid_argument);
  expect_drawn(GuardedFrame(8, 8, {}).copy(), frame, "unchanged");
}

}  // namespace
}  // namespace edgewise

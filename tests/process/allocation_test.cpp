// Memory is reused from frame to frame: after the first frame, nothing is allocated. A global operator new,
// which replaces the standard one in the whole test program, counts the allocations.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "edgewise/builtin.h"
#include "edgewise/draw.h"
#include "frontend/mesh_clusters.h"
#include "support.h"

namespace {
std::atomic<std::size_t> allocations{0};
thread_local std::size_t of_this_thread = 0;

void* counted(std::size_t bytes, std::size_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  ++of_this_thread;
  const std::size_t whole = (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, whole)) return memory;
  throw std::bad_alloc();
}
}  // namespace

// By default, all other forms of new and delete call these.
void* operator new(std::size_t bytes) {
  return counted(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace edgewise {
namespace {

template <typename Work>
std::size_t allocations_in(Work&& work) {
  const std::size_t before = allocations;
  work();
  return allocations - before;
}

// Draws the first frame, then counts: the minimum of several, since oneTBB's workers also allocate when they
// start and end, but not in every frame.
template <typename Frame>
void expect_in_the_first_frame_only(Frame&& frame, const std::string& what) {
  frame();
  std::size_t least = allocations_in(frame);
  for (int i = 0; i < 5; ++i) least = std::min(least, allocations_in(frame));
  EXPECT_EQ(least, 0u) << what;
}

class Allocations : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Allocations, OfABackendHappenInTheFirstFrameOnly) {
  constexpr int kWidth = 320, kHeight = 200;
  const auto backend = testing::find_drawer(GetParam()).make();
  Framebuffer frame(kWidth, kHeight);
  for (const int threads : {1, 2, 8})
    for (const auto& [family, count] : {std::pair{"cloud", 9'000}, {"uniform", 200}}) {
      const auto triangles = testing::adversarial(family, count, kWidth, kHeight, 7);
      const auto draw = [&] {
        FrameView view = frame.view();
        backend->draw(triangles, view, {testing::kBackground}, {.threads = threads});
        view.payload = nullptr;
        backend->draw(triangles, view, {.clear = false, .scissor = {9, 9, 99, 99}}, {.threads = threads});
      };
      expect_in_the_first_frame_only(draw, std::string(family) + ", threads: " + std::to_string(threads));
    }
  const Drawable stream = find_scene("micro").make({.width = kWidth, .height = kHeight, .scale = 0.01});
  const FrontendOptions options{.width = kWidth, .height = kHeight, .cull = Cull::none};
  for (const int threads : {1, 2}) {
    Frontend frontend;
    const auto draw_it = [&] {
      draw(stream, frontend, options, *backend, frame.view(), {testing::kBackground}, {.threads = threads});
    };
    expect_in_the_first_frame_only(draw_it, "a stream, threads: " + std::to_string(threads));
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, Allocations, ::testing::ValuesIn(testing::all_drawers()),
                         [](const auto& param) { return testing::test_name(param); });

TEST(FrontendAllocations, HappenInTheFirstFrameOnly) {
  for (const SceneInfo& info : builtin_scenes()) {
    const Drawable drawable = info.make({.width = 640, .height = 480, .scale = 0.02});
    for (const int threads : {1, 2, 8}) {
      Frontend frontend;
      const auto run = [&] { frontend.run(drawable, {.width = 640, .height = 480}, {.threads = threads}); };
      EXPECT_GT(allocations_in(run), 0u) << info.name;
      expect_in_the_first_frame_only(run, std::string(info.name) + ", threads: " + std::to_string(threads));
    }
  }
}

// Meshes with clusters around the camera, so that what is in view differs from frame to frame: one large
// mesh, and several instances of a smaller one. Other threads are not counted: oneTBB's workers allocate when
// they start and end.
TEST(FrontendAllocations, DoNotHappenWhenTheCameraTurns) {
  for (const char* name : {"terrain", "knots"}) {
    Drawable drawable = find_scene(name).make({.scale = 0.3});
    make_clusters(drawable);
    Scene& scene = std::get<Scene>(drawable);
    if (scene.instances.size() > 1) scene.camera.position = glm::vec3(0);
    for (const int threads : {1, 2}) {
      const FrontendOptions options{.width = 64, .height = 48};
      const Execution execution{.threads = threads};
      Frontend().run(drawable, options, execution);  // oneTBB allocates when it starts
      Frontend frontend;
      const auto run = [&] { frontend.run(drawable, options, execution); };
      scene.camera.pitch = 1.5f;  // up, where few clusters are
      run();
      scene.camera.pitch = 0;
      for (int i = 0; i < 24; ++i) {
        scene.camera.yaw = 0.5f * float(i);
        const std::size_t before = of_this_thread;
        run();
        EXPECT_EQ(of_this_thread - before, 0u) << name << ", " << threads << " threads, frame " << i;
      }
    }
  }
}

}  // namespace
}  // namespace edgewise

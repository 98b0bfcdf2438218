// The front end allocates nothing after the first frame of a kind. Counted by the global operator new, which
// is replaced for the whole test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "frontend/frontend.h"
#include "scene/builtin.h"

namespace {
std::atomic<std::size_t> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace edgewise {
namespace {

TEST(FrontendAllocation, OnlyTheFirstFrameAllocates) {
  for (const SceneInfo& info : builtin_scenes())
    for (const int threads : {1, 2}) {
      const Drawable drawable = info.make({.width = 640, .height = 480, .scale = 0.02});
      const FrontendOptions options{.width = 640, .height = 480, .threads = threads};
      Frontend frontend;
      const std::size_t before = allocations;
      frontend.run(drawable, options);
      const std::size_t after_first = allocations;
      EXPECT_GT(after_first, before) << info.name;
      for (int frame = 0; frame < 3; ++frame) frontend.run(drawable, options);
      EXPECT_EQ(allocations, after_first) << info.name << " with " << threads << " threads";
    }
}

}  // namespace
}  // namespace edgewise

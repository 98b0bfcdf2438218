// Draws frames of a scene with a turning camera into the caller's memory. Checks that only the first frame
// allocates, that no memory beside the frame is written, and that an empty frame overwrites the previous one.
#include <edgewise/backend.h>
#include <edgewise/builtin.h>
#include <edgewise/frontend.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(std::max<std::size_t>(bytes, 1))) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

int main() {
  using namespace edgewise;
  constexpr int kWidth = 320, kHeight = 180, kStride = 333, kFrames = 20;
  constexpr std::uint32_t kUntouched = 0xDEADBEEF, kBackground = 0xFF000000;
  std::vector<std::uint32_t> depth(kStride * kHeight, kUntouched), payload = depth;
  const FrameView frame{depth.data(), payload.data(), kWidth, kHeight, kStride};
  const auto in_frame = [&](std::uint32_t value) {
    return std::count(payload.begin(), payload.end(), value);
  };

  Drawable drawable = find_scene("cubes").make({.width = kWidth, .height = kHeight});
  Frontend frontend;
  const auto backend = find_backend("tiled").make();
  std::size_t after_first = 0;
  for (int i = 0; i < kFrames; ++i) {
    std::get<Scene>(drawable).camera.yaw = 0.01f * static_cast<float>(i);  // radians
    backend->draw(frontend.run(drawable, {.width = kWidth, .height = kHeight}), frame, {kBackground});
    if (i == 0) after_first = allocations;
  }
  const std::size_t later = allocations - after_first;
  const auto drawn =
      static_cast<std::ptrdiff_t>(payload.size()) - in_frame(kBackground) - in_frame(kUntouched);
  backend->draw({}, frame, {kBackground});
  const bool empty = in_frame(kBackground) == kWidth * kHeight;
  const bool kept = in_frame(kUntouched) == (kStride - kWidth) * kHeight;
  std::printf("%zu allocations in the first frame, %zu in %d later ones; %td pixels drawn\n", after_first,
              later, kFrames - 1, drawn);
  return later == 0 && drawn > 1000 && empty && kept ? 0 : 1;
}

// The library's limits: beyond them it throws std::invalid_argument before it allocates or reads memory. The
// programs' limits are in tests/cli/invalid_inputs.h.
#include "edgewise/limits.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>

#include "core/buffer.h"
#include "edgewise/backend.h"
#include "edgewise/contract.h"
#include "edgewise/frontend.h"
#include "edgewise/visible.h"
#include "lab/cases/backend_comparison.h"
#include "support.h"

namespace edgewise {
namespace {

// 2^30 + 2^20 triangles of one small mesh.
Scene too_many() {
  Mesh mesh;
  mesh.positions = {{0, 0, -1}, {0, 1, -1}, {1, 0, -1}};
  mesh.triangles.assign(1 << 20, glm::uvec3(0, 1, 2));
  mesh.colours.assign(1 << 20, 0);
  Scene scene = testing::scene_of(std::move(mesh));
  scene.instances.assign(1025, {});
  return scene;
}

// Exits with 0 if `action` throws std::invalid_argument. The address space is limited, so that an allocation
// in proportion to the input fails.
void exit_as_refused(const std::function<void()>& action) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  constexpr rlim_t kBytes = rlim_t{1} << 30;
  const rlimit limit{kBytes, kBytes};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::exit(1);
#endif
  try {
    action();
  } catch (const std::invalid_argument&) {
    std::exit(0);
  } catch (...) {
    std::exit(2);
  }
  std::exit(3);
}

void expect_refused(const std::function<void()>& action) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(exit_as_refused(action), ::testing::ExitedWithCode(0), "");
}

TEST(LimitsDeathTest, TheFrontEndAndObjectsRefuseTooManyTriangles) {
  expect_refused([] { Frontend().run(too_many(), {}); });
  expect_refused([] {
    Scene scene = too_many();
    scene.instances.resize(1);
    scene.meshes[0].parts.assign(1025, {"a", 0, 1 << 20});
    (void)objects(scene);
  });
}

TEST(LimitsDeathTest, EveryBackendRefusesTooManyTriangles) {
  for (const BackendInfo& info : backends())
    expect_refused([&] {
      const ScreenTriangle one{};  // never read
      Framebuffer frame(8, 8);
      info.make()->draw(std::span(&one, kMaxTriangles + 1), frame.view());
    });
}

// The size in bytes must not wrap, as the worst case of a capacity may where size_t has 32 bits.
TEST(Limits, ABufferOfMoreBytesThanCanBeAddressedIsRefused) {
  Buffer<std::uint64_t> buffer;
  EXPECT_THROW(buffer.reserve(SIZE_MAX / sizeof(std::uint64_t) + 2), std::bad_alloc);
  EXPECT_EQ(buffer.capacity(), 0u);
}

// Both sides at the limit: a frame of 2 GiB.
TEST(Limits, TheLargestImageIsDrawn) {
  if (!testing::full_size()) GTEST_SKIP() << "takes 2 GiB; scripts/test --full draws it";
  constexpr int kSide = contract::kMaxImageSide;
  const TriangleStream stream{1, 1, {{{{-20'000, 0, 0.5f}, {60'000, 0, 0.5f}, {0, 60'000, 0.5f}}, 7}}};
  Framebuffer frame(kSide, kSide);
  for (const BackendInfo& info : backends()) {
    Frontend frontend;
    lab::poison(frame);
    info.make()->draw(frontend.run(stream, {.width = kSide, .height = kSide, .cull = Cull::none}),
                      frame.view(), {0}, {.threads = 2});
    std::uint64_t wrong = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) wrong += frame.payload_row(y)[x] != 7;
    EXPECT_EQ(wrong, 0u) << info.name;
  }
}

}  // namespace
}  // namespace edgewise

// A backend must not leave the upper halves of vector registers in use: every write of the caller's SSE code
// would merge into them, at half speed until the next context switch. The results do not change, so no other
// test detects it.
#include <gtest/gtest.h>

#include <optional>

#include "edgewise/framebuffer.h"
#include "support.h"

#if defined(__x86_64__)
#include <cpuid.h>

namespace edgewise {
namespace {

constexpr std::uint32_t kUpperHalves = 1u << 2 | 1u << 6;  // of YMM, of ZMM

// The state components that the processor reports as in use (XGETBV with ECX = 1); none if it cannot report
// them.
std::optional<std::uint32_t> upper_halves_in_use() {
  std::uint32_t a = 0, b = 0, c = 0, d = 0;
  constexpr std::uint32_t kOsxsave = 1u << 27, kXgetbv1 = 1u << 2;
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & kOsxsave)) return {};
  if (!__get_cpuid_count(0xD, 1, &a, &b, &c, &d) || !(a & kXgetbv1)) return {};
  asm volatile("xgetbv" : "=a"(a), "=d"(d) : "c"(1));
  return a & kUpperHalves;
}

// In assembly, since the tests are compiled for SSE.
void clear_upper_halves() {
  asm volatile("vzeroupper" ::: "memory");
}
void use_upper_halves() {
  asm volatile("vpcmpeqd %%ymm0, %%ymm0, %%ymm0" ::: "xmm0", "memory");
}

// Whether the processor's report is exact: some processors report unused registers as in use.
bool reports_exactly() {
  if (!__builtin_cpu_supports("avx2") || !upper_halves_in_use()) return false;
  use_upper_halves();
  const bool sees_use = *upper_halves_in_use() != 0;
  clear_upper_halves();
  return sees_use && *upper_halves_in_use() == 0;
}

TEST(VectorState, BackendsLeaveUpperHalvesUnused) {
  if (!reports_exactly())
    GTEST_SKIP() << "this processor does not report the use of vector registers exactly";
  constexpr int kWidth = 200, kHeight = 150;  // several tiles of every size
  const auto everywhere = testing::adversarial("uniform", 200, kWidth, kHeight, 1);
  const auto in_a_corner = testing::adversarial("cloud", 5, 8, 8, 18);
  for (const BackendInfo& info : backends())
    for (const SimdTarget target : supported_targets())
      for (const auto& triangles : {everywhere, in_a_corner, std::vector<ScreenTriangle>{}}) {
        Framebuffer frame(kWidth, kHeight);
        const auto backend = info.make();
        clear_upper_halves();
        backend->draw(triangles, frame.view(), {testing::kBackground}, {.threads = 1, .target = target});
        const std::uint32_t in_use = *upper_halves_in_use();
        clear_upper_halves();
        EXPECT_EQ(in_use, 0u) << info.name << ", " << name_of(target) << ", " << triangles.size()
                              << " triangles";
      }
}

}  // namespace
}  // namespace edgewise
#endif

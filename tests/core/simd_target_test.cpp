// The listed SIMD targets and their kernels do not depend on the build's flags.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/simd_target_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstdint>

#include "core/kernel_table.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

std::int64_t compiled_for() {
  return HWY_TARGET;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "frontend/shade.h"
#include "frontend/tasks.h"
#include "frontend/transform.h"
#include "raster/binning/packet_sorter.h"
#include "raster/kernels.h"

namespace edgewise {
namespace {

TEST(SimdTargets, AreThoseCompiledAndSupported) {
  const struct {
    SimdTarget target;
    std::int64_t highway;
  } all[] = {{SimdTarget::scalar, HWY_SCALAR},
             {SimdTarget::sse4, HWY_SSE4},
             {SimdTarget::avx2, HWY_AVX2},
             {SimdTarget::avx512, HWY_AVX3},
             {SimdTarget::neon, HWY_NEON}};
  const auto available = HWY_TARGETS & (hwy::SupportedTargets() | HWY_SCALAR | HWY_NEON);
  std::vector<SimdTarget> expected;
  for (const auto& [target, highway] : all) {
    if ((available & highway) == 0) continue;
    expected.push_back(target);
    const auto kernel = EDGEWISE_KERNEL(compiled_for, target);
    ASSERT_NE(kernel, nullptr) << name_of(target);
    EXPECT_EQ(kernel(), highway) << name_of(target);
  }
  const auto listed = supported_targets();
  EXPECT_EQ(std::vector(listed.begin(), listed.end()), expected);
  EXPECT_EQ(listed.front(), SimdTarget::scalar) << "for every build flag";
}

// Fails if a target's kernel is missing or the same as another target's.
template <typename Kernel>
void expect_own_kernels(Kernel (*kernel_of)(SimdTarget), const char* name) {
  std::set<Kernel> kernels;
  for (const SimdTarget target : supported_targets()) {
    EXPECT_NE(kernel_of(target), nullptr) << name << ", " << name_of(target);
    EXPECT_TRUE(kernels.insert(kernel_of(target)).second) << name << ", " << name_of(target);
  }
}

TEST(SimdTargets, HaveDifferentKernels) {
  expect_own_kernels(frame_spans, "spans in the frame");
  expect_own_kernels(frame_edges, "edges in the frame");
  expect_own_kernels(tile_spans, "spans in tiles");
  expect_own_kernels(tile_edges, "edges in tiles");
  expect_own_kernels(packet_sorter, "packets");
  expect_own_kernels(transform_kernel, "transform");
  expect_own_kernels(index_range_kernel, "index range");
  expect_own_kernels(assemble_kernel, "assemble");
  expect_own_kernels(shade_kernel, "shade");
  expect_own_kernels(stream_kernel, "stream");
}

}  // namespace
}  // namespace edgewise
#endif

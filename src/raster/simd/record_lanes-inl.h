// Loads triangles that are consecutive in memory into vectors of 32-bit lanes.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "core/lanes-inl.h"
#include "edgewise/screen_triangle.h"

// Included once per SIMD target.
#if defined(EDGEWISE_RECORD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_RECORD_LANES_INL_H
#undef EDGEWISE_RECORD_LANES_INL_H
#else
#define EDGEWISE_RECORD_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR  // the scalar target has no pairs of lanes
using Pairs = hn::Repartition<std::int64_t, D>;
constexpr int kPairs = static_cast<int>(hn::MaxLanes(Pairs{}));
#endif

constexpr std::size_t kPrefetchBytes = 2560;  // prefetch distance

struct RecordLanes : TriangleLanes {
  // Loads kLanes triangles. `prefetch`: prefetch triangles that follow in memory.
  HWY_INLINE RecordLanes(const ScreenTriangle* triangles, bool prefetch)
      : TriangleLanes(load_triangles([&](int lane) { return triangles + lane; })) {
    if (prefetch)
      for (std::size_t i = 0; i < kLanes * sizeof(ScreenTriangle); i += 64)
        hwy::Prefetch(reinterpret_cast<const char*>(triangles) + kPrefetchBytes + i);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

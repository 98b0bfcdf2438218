// Processes a vector of stream triangles at a time, like assemble.cpp. A record is nine floats and a colour.
// As w = 1, there is no division. A triangle needs no clipping if its vertices lie in the guard band and have
// depths in [0, 1].
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/stream.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/lanes-inl.h"

#include <algorithm>

#include "core/kernel_table.h"
#include "frontend/tasks.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// The hardware prefetcher falls behind at 40 bytes per triangle. Without this, grid4 is drawn 1.08× slower on
// one thread, and 1.16× on two (Zen 4).
HWY_INLINE void prefetch(const TriangleStream& stream, std::size_t first) {
  constexpr std::size_t kAhead = 96, kCacheLine = 64;
  const std::size_t target = std::min(first + kAhead, stream.triangles.size() - kLanes);
  const auto* bytes = reinterpret_cast<const char*>(&stream.triangles[target]);
  for (std::size_t i = 0; i < kLanes * sizeof(StreamTriangle); i += kCacheLine) hwy::Prefetch(bytes + i);
}

// True for lanes whose three values lie in low … high; false for NaN.
HWY_INLINE hn::Mask<DF> within(const VF (&v)[3], float low, float high) {
  const DF d;
  const auto one = [&](VF f)
                       HWY_ATTR { return hn::And(hn::Ge(f, hn::Set(d, low)), hn::Le(f, hn::Set(d, high))); };
  return hn::And(one(v[0]), hn::And(one(v[1]), one(v[2])));
}

// True for lanes whose three values are all below 0, or all above `side_px`.
HWY_INLINE hn::Mask<D> beyond(const VF (&v)[3], int side_px) {
  const DF d;
  const VF low = hn::Min(v[0], hn::Min(v[1], v[2])), high = hn::Max(v[0], hn::Max(v[1], v[2]));
  return hn::RebindMask(
      D{}, hn::Or(hn::Lt(high, hn::Zero(d)), hn::Gt(low, hn::Set(d, static_cast<float>(side_px)))));
}

// Returns false and appends nothing if add_one() must handle these triangles.
HWY_INLINE bool stream_vector(const StreamTask& task, std::size_t first, ChunkOutput& out) {
  if (task.one_by_one()) return false;
  constexpr auto kGuardPx = static_cast<float>(contract::kMaxImageSide);
  const FrontendOptions& options = task.options;
  prefetch(task.stream, first);
  // Ten words like a screen triangle's, but vertex by vertex: t.x is the first one.
  static_assert(sizeof(StreamTriangle) == sizeof(ScreenTriangle));
  const TriangleLanes t = load_triangles([&](int lane) { return &task.stream.triangles[first] + lane; });
  const VF x[] = {real(t.x[0]), real(t.y[0]), real(t.z[0])}, y[] = {real(t.x[1]), real(t.y[1]), real(t.z[1])},
           z[] = {real(t.x[2]), real(t.y[2]), real(t.z[2])};
  const auto plain =
      hn::And(within(z, 0.0f, 1.0f), hn::And(within(x, -kGuardPx, kGuardPx), within(y, -kGuardPx, kGuardPx)));
  if (!hn::AllTrue(DF{}, plain)) return false;
  const bool ids = options.payload == Payload::id;
  const int bits = options.subpixel_bits;
  cull_and_append({{snap(x[0], bits), snap(x[1], bits), snap(x[2], bits)},
                   {snap(y[0], bits), snap(y[1], bits), snap(y[2], bits)},
                   {quantize_depth(z[0]), quantize_depth(z[1]), quantize_depth(z[2])},
                   ids ? counting_from(static_cast<int>(options.first_id + first)) : t.payload},
                  hn::Or(beyond(x, options.width), beyond(y, options.height)), options, out);
  return true;
}

void stream(const StreamTask& task, std::size_t begin, std::size_t end, ChunkOutput& out) {
  const auto one_by_one = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) add_one(task, i, out);
  };
  std::size_t i = begin;
  for (; i + kLanes <= end; i += kLanes)
    if (!stream_vector(task, i, out)) one_by_one(i, i + kLanes);
  one_by_one(i, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(StreamKernel, stream_kernel, stream)
#endif

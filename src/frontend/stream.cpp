// A vector of triangles at a time, as in assemble.cpp, from records of nine floats and a colour. With w = 1
// there is nothing to divide, and what needs no clipping is within the guard band and has a depth in [0, 1].
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/stream.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After Highway, which they need.
#include "frontend/cull-inl.h"
#include "frontend/lanes-inl.h"

#include <algorithm>

#include "core/kernel_table.h"
#include "frontend/one_by_one.h"
#include "frontend/stream.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// Forty bytes a triangle come faster than the hardware expects: asking for them early doubles the speed.
HWY_INLINE void prefetch(const TriangleStream& stream, std::size_t first) {
  constexpr std::size_t kAhead = 96, kCacheLine = 64;
  const std::size_t target = std::min(first + kAhead, stream.triangles.size() - kLanes);
  const auto* bytes = reinterpret_cast<const char*>(&stream.triangles[target]);
  for (std::size_t i = 0; i < kLanes * sizeof(StreamTriangle); i += kCacheLine) hwy::Prefetch(bytes + i);
}

struct StreamVectors {
  VF x[3], y[3], z[3];
  VI colour;
};

HWY_INLINE StreamVectors load(const StreamTriangle* triangles) {
  const auto words = [&](std::size_t first) HWY_ATTR {
    return load_words([&](std::size_t lane) {
      return reinterpret_cast<const char*>(triangles + lane) + first * sizeof(float);
    });
  };
  const auto real = [](VI v) HWY_ATTR { return hn::BitCast(DF{}, v); };
  const Words a = words(0), b = words(4), c = words(6);  // ten words: two are read twice
  return {{real(a.word[0]), real(a.word[3]), real(b.word[2])},
          {real(a.word[1]), real(b.word[0]), real(b.word[3])},
          {real(a.word[2]), real(b.word[1]), real(c.word[2])},
          c.word[3]};
}

// All in low … high; NaN is not.
HWY_INLINE hn::Mask<DF> within(const VF (&v)[3], float low, float high) {
  const DF d;
  const auto one = [&](VF f)
                       HWY_ATTR { return hn::And(hn::Ge(f, hn::Set(d, low)), hn::Le(f, hn::Set(d, high))); };
  return hn::And(one(v[0]), hn::And(one(v[1]), one(v[2])));
}

// All below 0, or all above `side_px`.
HWY_INLINE MI beyond(const VF (&v)[3], int side_px) {
  const DF d;
  const VF low = hn::Min(v[0], hn::Min(v[1], v[2])), high = hn::Max(v[0], hn::Max(v[1], v[2]));
  return hn::RebindMask(
      DI{}, hn::Or(hn::Lt(high, hn::Zero(d)), hn::Gt(low, hn::Set(d, static_cast<float>(side_px)))));
}

// False if the triangles must go one by one.
HWY_INLINE bool stream_vector(const StreamTask& job, std::size_t first, RunOutput& out) {
  if (job.one_by_one()) return false;
  constexpr auto kGuardPx = static_cast<float>(contract::kMaxImageSide);
  const FrontendOptions& options = job.options;
  prefetch(job.stream, first);
  const StreamVectors t = load(&job.stream.triangles[first]);
  const auto plain = hn::And(within(t.z, 0.0f, 1.0f),
                             hn::And(within(t.x, -kGuardPx, kGuardPx), within(t.y, -kGuardPx, kGuardPx)));
  if (!hn::AllTrue(DF{}, plain)) return false;
  const bool ids = options.payload == Payload::id;
  cull_and_append({{snap(t.x[0]), snap(t.x[1]), snap(t.x[2])},
                   {snap(t.y[0]), snap(t.y[1]), snap(t.y[2])},
                   {quantize_depth(t.z[0]), quantize_depth(t.z[1]), quantize_depth(t.z[2])},
                   ids ? counting_from(first) : t.colour},
                  hn::Or(beyond(t.x, options.width), beyond(t.y, options.height)), options.cull, out);
  return true;
}

void stream(const StreamTask& job, std::size_t begin, std::size_t end, RunOutput& out) {
  const auto one_by_one = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) add_one(job, i, out);
  };
  std::size_t i = begin;
  for (; i + kLanes <= end; i += kLanes)
    if (!stream_vector(job, i, out)) one_by_one(i, i + kLanes);
  one_by_one(i, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

StreamKernel stream_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(stream, target);
}

}  // namespace edgewise
#endif

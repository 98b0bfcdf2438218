// What tile kernels share around the drawing: prefetching triangles, and copying a finished tile to the
// frame by cached or streaming stores (raster/ablation.h).
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <span>

#include "edgewise/contract.h"
#include "raster/simd/lanes-inl.h"
#include "raster/tile_task.h"

// Included once a SIMD target.
#if defined(EDGEWISE_TILE_STORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_TILE_STORE_INL_H
#undef EDGEWISE_TILE_STORE_INL_H
#else
#define EDGEWISE_TILE_STORE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Where a tile lies in a plane of the frame.
struct Place {
  std::int32_t* at;
  std::ptrdiff_t stride;
  int width, height;  // px
  bool streaming;     // wanted, and the frame's alignment allows it
  int ahead;          // px, to where the frame goes on at the right; or 0

  Place(const TileTask& job, std::uint32_t* plane)
      : at(reinterpret_cast<std::int32_t*>(plane + job.y0 * job.frame.stride + job.x0)),
        stride(job.frame.stride),
        width(job.width()),
        height(job.height()),
        streaming(job.ablation.tile_store == TileStore::streaming &&
                  reinterpret_cast<std::uintptr_t>(plane) % sizeof(V) == 0 && stride % kLanes == 0),
        ahead(job.x0 + 2 * job.size() <= job.frame.width ? job.size() : 0) {}

  HWY_INLINE std::int32_t* row(int y) const { return at + y * stride; }
};

// Calls write(store), where store(v, pixels) writes a vector of pixels to the frame. Cached stores also
// prefetch the tile to the right, which is usually drawn next: its rows are too short for the hardware
// prefetcher, and a few stores that wait for memory stall all others. The scalar target stores pixel by
// pixel, where a prefetch costs more than it saves.
template <typename Write>
HWY_INLINE void write_to(const Place& to, Write&& write) {
  if (to.streaming) {
    write([](V v, std::int32_t* pixels) { hn::Stream(v, D{}, pixels); });
  } else {
    write([ahead = to.ahead](V v, std::int32_t* pixels) {
      if (kLanes > 1) __builtin_prefetch(pixels + ahead, 0, 2);  // to L2: L1 is the tile's
      hn::StoreU(v, D{}, pixels);
    });
  }
}

// For a tile that holds `value` everywhere.
inline void write_value(const Place& to, std::int32_t value) {
  write_to(to, [&](const auto& store) {
    const V v = hn::Set(D{}, value);
    for (int y = 0; y < to.height; ++y) {
      std::int32_t *at = to.row(y), *const end = at + to.width;
      for (; at + kLanes <= end; at += kLanes) store(v, at);
      std::fill(at, end, value);
    }
  });
}

HWY_INLINE void prefetch_triangles(const TileTask& job, std::span<const std::uint32_t> run) {
  for (const std::uint32_t index : run) {
    const auto* record = reinterpret_cast<const char*>(job.triangles + index);
    hwy::Prefetch(record);
    hwy::Prefetch(record + sizeof(ScreenTriangle) - 1);
  }
}

// draw(run) for the tile's runs of indices (Bins::Run). The records lie anywhere: each run's are asked for
// while the run before it is drawn.
template <typename Draw>
HWY_INLINE void draw_runs(const TileTask& job, Draw&& draw) {
  Bins::Run asked_for{};
  job.bins->for_each_run(job.cell, [&](const Bins::Run& run) {
    if (job.ablation.prefetch) prefetch_triangles(job, run.indices);
    if (!asked_for.indices.empty()) draw(asked_for);
    asked_for = run;
  });
  if (!asked_for.indices.empty()) draw(asked_for);
}

// Calls write(depth, payload) with the tile's places in the frame, and orders streaming stores before later
// ones.
template <typename Write>
HWY_INLINE void write_planes(const TileTask& job, Write&& write) {
  const Place depth(job, job.frame.depth), payload(job, job.frame.payload);
  write(depth, payload);
  hwy::FlushStream();
}

// What goes to the frame from a tile's buffers: vectors of pixels from the i-th on.
struct Depths {
  const std::int32_t* buffer;
  template <typename DX>
  HWY_INLINE hn::Vec<DX> operator()(DX d, int i) const {
    return hn::Load(d, buffer + i);
  }
};
// Their buffer needs no clear: it counts where something was drawn, which is nearer than kDepthClear.
struct Payloads {
  const std::int32_t *buffer, *depth;
  std::int32_t background;
  template <typename DX>
  HWY_INLINE hn::Vec<DX> operator()(DX d, int i) const {
    const auto clear = hn::Set(d, static_cast<std::int32_t>(contract::kDepthClear));
    const auto drawn = hn::Lt(hn::Load(d, depth + i), clear);
    return hn::IfThenElse(drawn, hn::Load(d, buffer + i), hn::Set(d, background));
  }
};

// Calls write(place, pixels) for both.
template <typename Write>
HWY_INLINE void write_tile(const TileTask& job, const std::int32_t* depth, const std::int32_t* payload,
                           Write&& write) {
  write_planes(job, [&](const Place& depth_place, const Place& payload_place) {
    write(depth_place, Depths{depth});
    write(payload_place, Payloads{payload, depth, static_cast<std::int32_t>(job.background)});
  });
}

// A tile without triangles needs no buffer.
HWY_INLINE void write_background(const TileTask& job) {
  write_planes(job, [&](const Place& depth, const Place& payload) {
    write_value(depth, static_cast<std::int32_t>(contract::kDepthClear));
    write_value(payload, static_cast<std::int32_t>(job.background));
  });
}

// Where a tile has no triangle, GCC 12 forgets this instruction between the clear and the return. The
// caller's code is SSE, and writes to registers whose upper halves are in use merge: it would run at half
// speed, until the next context switch.
HWY_INLINE void clear_upper_halves() {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2  // the better the target, the lower its number
  _mm256_zeroupper();
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

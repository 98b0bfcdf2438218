// Shared by the tile kernels: copies a finished tile to the frame by cached or streaming stores
// (raster/tile_options.h), and before that the frame to a tile that is drawn over it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/kernels.h"

// Included once per SIMD target.
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

// Streaming stores need aligned addresses.
HWY_INLINE bool may_stream(const std::uint32_t* plane, std::ptrdiff_t stride) {
  return reinterpret_cast<std::uintptr_t>(plane) % sizeof(V) == 0 && stride % kLanes == 0;
}

// A tile's part of a plane (depth or payload) of the frame.
struct FramePlane {
  std::int32_t* at;
  std::ptrdiff_t stride;
  int left, top, width, height;  // px, as in TileTask
  bool streaming;                // requested, and possible with the frame's alignment
  int ahead;                     // px to the tile at the right; 0 if there is none

  FramePlane(const TileTask& task, std::uint32_t* plane)
      : at(reinterpret_cast<std::int32_t*>(plane + task.y0 * task.part.frame.stride + task.x0)),
        stride(task.part.frame.stride),
        left(task.left()),
        top(task.top()),
        width(task.width()),
        height(task.height()),
        streaming(task.streaming && may_stream(plane, stride)),
        ahead(task.x0 + 2 * task.size() <= task.part.frame.width ? task.size() : 0) {}

  HWY_INLINE std::int32_t* row(int y) const { return at + y * stride; }
};

// Calls write(store), where store(v, pixels) writes a vector of pixels to the frame. Cached stores also
// prefetch the tile to the right, which is usually drawn next: its rows are too short for the hardware
// prefetcher, and a few stores that wait for memory stall all others. The scalar target stores pixel by
// pixel, where a prefetch costs more than it saves.
template <typename Write>
HWY_INLINE void write_to(const FramePlane& to, Write&& write) {
  if (to.streaming) {
    write([](V v, std::int32_t* pixels) { hn::Stream(v, D{}, pixels); });
  } else {
    write([ahead = to.ahead](V v, std::int32_t* pixels) {
      if (kLanes > 1) __builtin_prefetch(pixels + ahead, 0, 2);  // to L2: L1 is the tile's
      hn::StoreU(v, D{}, pixels);
    });
  }
}

// Vectors of pixels from a tile's buffers, from the i-th pixel on, as they are stored to the frame.
struct Buffered {
  const std::int32_t* buffer;
  template <typename DX>
  HWY_INLINE hn::Vec<DX> operator()(DX d, int i) const {
    return hn::Load(d, buffer + i);
  }
};
// With the background at pixels whose depth is clear, so the payload buffer needs no clear.
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

// Calls write(plane, pixels) for depth and payload, and orders streaming stores before later stores.
template <typename Write>
HWY_INLINE void write_tile(const TileTask& task, const std::int32_t* depth, const std::int32_t* payload,
                           Write&& write) {
  const FrameView& frame = task.part.frame;
  write(FramePlane(task, frame.depth), Buffered{depth});
  if (frame.payload != nullptr) {
    const FramePlane plane(task, frame.payload);
    if (task.part.clear)
      write(plane, Payloads{payload, depth, static_cast<std::int32_t>(task.part.background)});
    else
      write(plane, Buffered{payload});
  }
  hwy::FlushStream();
}

// Unless the frame is cleared, calls read(plane, buffer) for depth and payload.
template <typename Read>
HWY_INLINE void read_tile(const TileTask& task, std::int32_t* depth, std::int32_t* payload, Read&& read) {
  const FrameView& frame = task.part.frame;
  if (task.part.clear) return;
  read(FramePlane(task, frame.depth), depth);
  if (frame.payload != nullptr) read(FramePlane(task, frame.payload), payload);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// Copies a finished tile to the frame by cached or streaming stores (raster/traversals.h), and before that
// the frame to a tile that is drawn over it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

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
// prefetcher, and a few stores that wait for memory stall all others. Without it, tiled draws grid64 1.2×
// slower (one thread, Zen 4). The scalar target stores pixel by pixel, where a prefetch costs more than it
// saves.
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

// A tile in blocks of 4 x 4 pixels, each 16 consecutive integers.
constexpr int kBlockSide = 4;  // px
constexpr int kBlockPixels = kBlockSide * kBlockSide;
constexpr int kMaxBlocks = contract::kMaxTile / kBlockSide;  // per side of a tile

// The index of a pixel.
HWY_INLINE int in_blocks(int x, int y) {
  return (y / kBlockSide * kMaxBlocks + x / kBlockSide) * kBlockPixels + y % kBlockSide * kBlockSide +
         x % kBlockSide;
}

// Calls copy(x, count) for the pixels of a row from column x on, block by block. A constant count makes
// copies of whole blocks short.
template <typename Copy>
HWY_INLINE void for_each_block_of_row(int x, int width, Copy&& copy) {
  while (x < width)
    if (x % kBlockSide == 0 && x + kBlockSide <= width)
      copy(x, std::integral_constant<int, kBlockSide>{}), x += kBlockSide;
    else
      copy(x, std::integral_constant<int, 1>{}), ++x;
}

inline void read_blocks(const FramePlane& from, std::int32_t* buffer) {
  for (int y = from.top; y < from.height; ++y)
    for_each_block_of_row(from.left, from.width, [&, row = from.row(y)](int x, auto count) {
      std::copy_n(row + x, count(), buffer + in_blocks(x, y));
    });
}

#if HWY_TARGET != HWY_SCALAR
// Two neighbouring pixel rows of neighbouring blocks, a vector each. `from`: index of the first row's first
// pixel.
template <typename Pixels>
HWY_INLINE void two_rows_of_blocks(const Pixels& pixels, int from, V& upper, V& lower) {
  const D d;
#if HWY_MAX_BYTES == 16
  upper = pixels(d, from);
  lower = pixels(d, from + kBlockSide);
#elif HWY_TARGET == HWY_AVX2
  const V left = pixels(d, from), right = pixels(d, from + kBlockPixels);
  upper = hn::ConcatLowerLower(d, right, left);
  lower = hn::ConcatUpperUpper(d, right, left);
#else
  const hn::Half<D> half;
  const auto of_blocks = [&](int first, int second) {
    return hn::Combine(d, pixels(half, from + second * kBlockPixels),
                       pixels(half, from + first * kBlockPixels));
  };
  const V even = of_blocks(0, 2), odd = of_blocks(1, 3);
  upper = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd), even);
  lower = hn::OddEvenBlocks(odd, hn::SwapAdjacentBlocks(even));
#endif
}
#endif

// Stores blocks as rows. Each row is written to its end before the next: processors fetch neighbouring cache
// lines together, and lines of several rows often compete for the same cache sets.
template <typename Pixels>
void write_blocks(const FramePlane& to, const Pixels& pixels) {
  int whole_width = 0, whole_height = 0;  // px, the part that is stored in whole vectors
#if HWY_TARGET != HWY_SCALAR
  if (to.left == 0 && to.top == 0) whole_width = to.width & -kLanes, whole_height = to.height & -2;
  constexpr int kMost = contract::kMaxTile / kLanes;
  write_to(to, [&](const auto& store) {
    const auto write_two_rows = [&](int y, int count) {
      std::int32_t *const upper_row = to.row(y), *const lower_row = to.row(y + 1);
      V lower[kMost];
      for (int i = 0; i < count; ++i) {
        V upper;
        two_rows_of_blocks(pixels, in_blocks(i * kLanes, y), upper, lower[i]);
        store(upper, upper_row + i * kLanes);
      }
      for (int i = 0; i < count; ++i) store(lower[i], lower_row + i * kLanes);
    };
    for (int y = 0; y < whole_height; y += 2)
      to.width == contract::kMaxTile ? write_two_rows(y, kMost) : write_two_rows(y, to.width / kLanes);
  });
#endif
  for (int y = to.top; y < to.height; ++y)
    for_each_block_of_row(y < whole_height ? whole_width : to.left, to.width,
                          [&, row = to.row(y)](int x, auto count) {
                            const hn::CappedTag<std::int32_t, 1> one;
                            std::int32_t part[decltype(count)::value];
                            for (int i = 0; i < count(); ++i)
                              part[i] = hn::GetLane(pixels(one, in_blocks(x, y) + i));
                            std::copy_n(part, count(), row + x);
                          });
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

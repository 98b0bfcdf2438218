// The scanline kernel.
//
// 1. Triangles are set up a vector at a time (scanline_setup-inl.h). Their spans are found a vector of rows
//    at a time (scanline_rows-inl.h), and filled a vector of pixels at a time (scanline_list-inl.h).
// 2. Spans end at the sides of a tile. Spans as long as the image would need fewer set-ups, but a band of
//    rows does not fit the L1 cache, while a tile of 32 KB does. The tile is stored to the frame once, with
//    the background where its depths are still clear. It lies in one depth cell (rule 6), so a span has one
//    depth plane.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/scanline/scanline_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/scanline/scanline_list-inl.h"
#include "raster/scanline/scanline_walk.h"
#include "raster/tile_task.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

namespace {

// Draws triangles into a tile, in the order of its calls.
#if HWY_TARGET == HWY_SCALAR

class SpanPainter {
 public:
  explicit SpanPainter(const TileTask& task) : task_(task) {
    std::fill_n(depth_, kMaxTile * kMaxTile, static_cast<std::int32_t>(kDepthClear));
  }
  void draw(std::span<const std::uint32_t> indices) {
    for (const std::uint32_t index : indices) walk_triangle(task_, task_.triangles[index], depth_, payload_);
  }
  const std::int32_t* depth() const { return depth_; }
  const std::int32_t* payload() const { return payload_; }

 private:
  const TileTask& task_;
  std::int32_t depth_[kMaxTile * kMaxTile], payload_[kMaxTile * kMaxTile];
};

#else

class SpanPainter {
 public:
  explicit SpanPainter(const TileTask& task) : task_(task) {
    std::fill_n(tile_.depth, std::size(tile_.depth), static_cast<std::int32_t>(kDepthClear));
    tile_.hiz.clear(task.width(), task.height());
  }
  void draw(std::span<const std::uint32_t> indices) {
    const TriangleBits accepted = set_up(task_, indices, batch_);
    for (std::uint32_t left = accepted.all; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (accepted.integer_walk >> k & 1) {
        list_.draw();
        walk_triangle(task_, task_.triangles[indices[static_cast<std::size_t>(k)]], tile_.depth,
                      tile_.payload);
      } else {
        list_.add(batch_, k);
      }
    }
    list_.draw();
  }
  const std::int32_t* depth() const { return tile_.depth; }
  const std::int32_t* payload() const { return tile_.payload; }

 private:
  const TileTask& task_;
  SpanTile tile_;
  SpanList list_{tile_};
  SpanBatch batch_;
};

#endif

template <typename Pixels>
void write_rows(const FramePlane& to, const Pixels& pixels) {
  write_to(to, [&](const auto& store) {
    for (int y = 0; y < to.height; ++y) {
      std::int32_t* const row = to.row(y);
      int x = 0;
      for (; x + kLanes <= to.width; x += kLanes) store(pixels(D{}, y * kMaxTile + x), row + x);
      for (; x < to.width; ++x)
        row[x] = hn::GetLane(pixels(hn::CappedTag<std::int32_t, 1>{}, y * kMaxTile + x));
    }
  });
}

}  // namespace

void draw_tile_in_spans(const TileTask& task) {
  SpanPainter painter(task);
  draw_segments(task, [&](const Bins::Segment& segment) { painter.draw(segment.indices); });
  write_tile(task, painter.depth(), painter.payload(),
             [](const FramePlane& to, const auto& pixels) { write_rows(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace edgewise {

TileKernel scanline_kernel(SimdTarget target) {
  return EDGEWISE_KERNEL(draw_tile_in_spans, target);
}

}  // namespace edgewise
#endif

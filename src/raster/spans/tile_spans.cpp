// Fills triangles by their spans, in a tile's buffer.
//
// 1. Triangles are set up a vector at a time. Their spans are found a vector of rows at a time
//    (span_rows-inl.h), and filled a vector of pixels at a time (span_list-inl.h).
// 2. Spans end at the sides of a tile. Spans as long as the image would need fewer set-ups, but a band of
//    rows does not fit the L1 cache, while a tile of 32 KB does. The tile is stored to the frame once, with
//    the background where its depths are still clear. It lies in one depth cell (rule 6), so a span has one
//    depth plane.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/spans/tile_spans.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/fill_counts.h"
#include "raster/kernels.h"
#include "raster/spans/edge_walk.h"
#include "raster/spans/span_list-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

namespace {

// Draws a triangle into a tile by integers alone. `depth`, `payload`: the tile's buffers, in rows of kMaxTile
// pixels.
void walk_triangle(const TileTask& task, const ScreenTriangle& triangle, std::int32_t* depth,
                   std::int32_t* payload) {
  PixelBox box = pixel_box(triangle, task.x0 + task.width(), task.y0 + task.height());
  box.x0 = std::max(box.x0, task.x0), box.y0 = std::max(box.y0, task.y0);
  const Oriented t = orient(triangle);
  if (box.empty() || t.area == 0) return;
  count(Part::tile_spans);
  const DepthPlane plane = make_depth(t);
  for_each_span(t, box, [&](int y, int begin, int end) {
    const int row = (y - task.y0) * kMaxTile;  // the tile is one depth cell
    fill_span(depth + row, payload + row, begin - task.x0, end - task.x0, plane.at(task.x0, y), plane.zx,
              triangle.payload);
  });
}

void read_rows(const FramePlane& from, std::int32_t* buffer) {
  for (int y = from.top; y < from.height; ++y)
    std::copy(from.row(y) + from.left, from.row(y) + from.width, buffer + y * kMaxTile + from.left);
}

// Draws triangles and coverage masks into a tile, in the order of its calls.
#if HWY_TARGET == HWY_SCALAR

class SpanPainter {
 public:
  explicit SpanPainter(const TileTask& task) : task_(task) {
    std::fill_n(depth_, kMaxTile * kMaxTile, static_cast<std::int32_t>(kDepthClear));
    read_tile(task, depth_, payload_, read_rows);
  }
  void draw(const Bins::Segment& segment) {
    for (const std::uint32_t index : segment.indices)
      walk_triangle(task_, task_.triangles[index], depth_, payload_);
  }
  void draw_rest() {}  // binning makes no masks without vectors
  const std::int32_t* depth() const { return depth_; }
  const std::int32_t* payload() const { return payload_; }

 private:
  const TileTask& task_;
  std::int32_t depth_[kMaxTile * kMaxTile], payload_[kMaxTile * kMaxTile];
};

#else

class SpanPainter {
 public:
  explicit SpanPainter(const TileTask& task)
      : task_(task), list_(tile_, task.hierarchical_depth), masks_(*task.bins, task.cell) {
    std::fill_n(tile_.depth, std::size(tile_.depth), static_cast<std::int32_t>(kDepthClear));
    read_tile(task, tile_.depth, tile_.payload, read_rows);
    tile_.hiz.clear(task.width(), task.height());
  }
  void draw(const Bins::Segment& segment) {
    const BatchBits accepted = set_up(task_, segment.indices, batch_);
    for (std::uint32_t left = accepted.drawn; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      masks_.draw_before(segment, k, draw_masks_);
      if (accepted.scalar >> k & 1) {
        list_.draw();
        walk_triangle(task_, task_.triangles[segment.indices[k]], tile_.depth, tile_.payload);
      } else {
        list_.add(batch_, static_cast<int>(k));
      }
    }
    list_.draw();
  }
  void draw_rest() { masks_.draw_rest(draw_masks_); }
  const std::int32_t* depth() const { return tile_.depth; }
  const std::int32_t* payload() const { return tile_.payload; }

 private:
  struct DrawMasks {
    SpanPainter& painter;
    std::size_t operator()(std::span<const CoverageMask> masks, std::uint32_t last) const {
      painter.list_.draw();
      return draw_masks(painter.tile_, masks, last);
    }
  };

  const TileTask& task_;
  SpanTile tile_;
  SpanList list_;
  Bins::MaskReader masks_;
  DrawMasks draw_masks_{*this};
  SpanBatch batch_;
};

#endif

template <typename Pixels>
void write_rows(const FramePlane& to, const Pixels& pixels) {
  write_to(to, [&](const auto& store) {
    for (int y = to.top; y < to.height; ++y) {
      std::int32_t* const row = to.row(y);
      int x = to.left;
      const auto one_by_one = [&](int end) {
        for (; x < end; ++x) row[x] = hn::GetLane(pixels(hn::CappedTag<std::int32_t, 1>{}, y * kMaxTile + x));
      };
      one_by_one(std::min((x + kLanes - 1) & -kLanes, to.width));
      for (; x + kLanes <= to.width; x += kLanes) store(pixels(D{}, y * kMaxTile + x), row + x);
      one_by_one(to.width);
    }
  });
}

}  // namespace

void draw_spans_in_tile(const TileTask& task) {
  SpanPainter painter(task);
  task.bins->for_each_segment_ahead(task.cell, [&](const Bins::Segment& segment) { painter.draw(segment); });
  painter.draw_rest();
  write_tile(task, painter.depth(), painter.payload(),
             [](const FramePlane& to, const auto& pixels) { write_rows(to, pixels); });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(TileKernel, tile_spans, draw_spans_in_tile)
#endif

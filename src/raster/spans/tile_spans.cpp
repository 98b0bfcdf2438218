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
#include "raster/kernels.h"
#include "raster/spans/integer_spans.h"
#include "raster/spans/span_list-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

namespace {

void read_rows(const FramePlane& from, std::int32_t* buffer) {
  for (int y = from.top; y < from.height; ++y)
    std::copy(from.row(y) + from.left, from.row(y) + from.width, buffer + y * kMaxTile + from.left);
}

// Draws triangles and coverage masks into a tile, in the order of its calls.
template <class G>
class SpanPainter {
 public:
  explicit SpanPainter(const TileTask& task)
      : task_(task), list_(tile_, task.hierarchical_depth), mask_reader_(task.bins, task.cell) {
    std::fill_n(tile_.depth, std::size(tile_.depth), static_cast<std::int32_t>(kDepthClear));
    read_tile(task, tile_.depth, tile_.payload, read_rows);
    tile_.hiz.clear(task.width(), task.height());
  }
  void draw(const Bins::Segment& segment) {
    batch_.by_integers = 0;
    std::uint32_t drawn = set_up_batch(segment.indices, [&](const std::uint32_t* padded, int k) {
      return set_up_vector(task_, padded + k, batch_, k);
    });
    for (; drawn != 0; drawn &= drawn - 1) {
      const int k = std::countr_zero(drawn);
      const auto in_segment = static_cast<std::size_t>(k);
      mask_reader_.draw_before(segment, in_segment, draw_lists_then_masks_);
#if HWY_TARGET != HWY_SCALAR
      if ((batch_.by_integers >> k & 1) == 0) {
        list_.add(batch_, k);
        continue;
      }
#endif
      list_.draw();
      draw_one(task_.bins.triangles()[segment.indices[in_segment]], k);
    }
    list_.draw();
  }
  void draw_rest() {
    mask_reader_.draw_rest(draw_lists_then_masks_);
  }
  const std::int32_t* depth() const {
    return tile_.depth;
  }
  const std::int32_t* payload() const {
    return tile_.payload;
  }

 private:
  struct DrawListsThenMasks {
    SpanPainter& painter;
    std::size_t operator()(std::span<const CoverageMask> masks, std::uint32_t last) const {
      painter.list_.draw();
      return draw_masks(painter.tile_, masks, last);
    }
  };

  // Fills the spans of triangle k of the batch row by row.
  void draw_one(const ScreenTriangle& triangle, int k) {
    count(Part::tile_spans);
    const int x0 = task_.x0, y0 = task_.y0;
    const PixelBox box{x0 + batch_.x0[k], y0 + batch_.y0[k], x0 + batch_.x1[k], y0 + batch_.y1[k]};
    const Oriented t = orient(triangle);
    const DepthPlane plane = make_depth(t);
    const auto fill = [&](int y, int begin, int end) {
      const int row = (y - y0) * kMaxTile;  // the tile is one depth cell
      fill_span(tile_.depth + row, tile_.payload + row, begin - x0, end - x0, plane.at(x0, y), plane.zx,
                triangle.payload);
    };
    if (batch_.by_integers >> k & 1)
      for_each_span(t, box, fill);
    else
      for_each_line_span(batch_.line, k, x0, box, fill);
  }

  const TileTask& task_;
  SpanTile tile_;
  SpanList<G> list_;
  Bins::MaskReader mask_reader_;
  DrawListsThenMasks draw_lists_then_masks_{*this};
  SpanBatch<G> batch_;
};

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

template <class G>
void draw_spans_on_grid(const TileTask& task) {
  SpanPainter<G> painter(task);
  task.bins.for_each_segment(task.cell, [&](const Bins::Segment& segment) { painter.draw(segment); });
  painter.draw_rest();
  write_tile(task, painter.depth(), painter.payload(),
             [](const FramePlane& to, const auto& pixels) { write_rows(to, pixels); });
  clear_upper_halves();
}

void draw_spans_in_tile(const TileTask& task) {
  task.bins.fine() ? draw_spans_on_grid<Fine>(task) : draw_spans_on_grid<Coarse>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(TileKernel, tile_spans, draw_spans_in_tile)
#endif

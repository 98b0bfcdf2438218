// Fills triangles by their spans, in the frame itself: the reference. Triangles are set up one per lane;
// their spans are filled a vector of pixels at a time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/spans/frame_spans.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/frame_lanes-inl.h"
#include "raster/kernels.h"
#include "raster/spans/integer_spans.h"
#include "raster/spans/line_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_NEON
// Fills a run of pixels, x … end - 1 of a row, which lies in one depth cell.
HWY_INLINE void fill_run(const FrameTask& task, const FrameRow& row, int x, int end, std::uint32_t z_in_cell,
                         std::uint32_t zx, V payload) {
  const V lane = hn::Iota(D{}, 0), z_in_vector = hn::Mul(lane, set(zx));
  const int cell_x = x & -kDepthCell;
  const auto z_from = [&](int at) {
    return hn::Add(set(z_in_cell + static_cast<std::uint32_t>(at - cell_x) * zx), z_in_vector);
  };
  if (x + kLanes <= end) {
    const V z_step = set(static_cast<std::uint32_t>(kLanes) * zx);
    for (V z = z_from(x); x + kLanes <= end; x += kLanes, z = hn::Add(z, z_step))
      write(row.depth + x, row.payload + x, /*all*/ hn::Eq(lane, lane), z, payload);
  }
  if (x == end) return;
  const int at = vector_from(x, task.region.x1);
  const auto in_run = between(x, hn::Add(lane, hn::Set(D{}, at)), end);
  write(row.depth + at, row.payload + at, in_run, z_from(at), payload);
}
#endif

// Fills the spans for which for_each(span) calls span(y, begin, end). Those with begin >= end are empty.
template <typename ForEach>
HWY_INLINE void fill_spans(const FrameTask& task, const FrameBatch& batch, int k, std::uint32_t payload,
                           ForEach&& for_each) {
  count(Part::frame_spans);
  const auto zx = static_cast<std::uint32_t>(batch.zx[k]);
  for_each([&](int y, int begin, int end) {
    const FrameRow row(task.frame, y);
    for (int x = begin, run_end; x < end; x = run_end) {
      const int cell_x = x & -kDepthCell;
      run_end = std::min(end, cell_x + kDepthCell);
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_NEON  // compilers vectorize it: fewer instructions on NEON
      fill_span(row.depth + cell_x, row.payload + cell_x, x - cell_x, run_end - cell_x,
                batch.z_in_cell(k, x, y), zx, payload);
#else
      fill_run(task, row, x, run_end, batch.z_in_cell(k, x, y), zx, set(payload));
#endif
    }
  });
}

template <class G>
struct FrameSpans : FrameBatch {
  BatchLine<G> line[3];
  std::uint32_t flat = 0;  // bit k: triangle k has too flat a line, and its spans are found by integers

  HWY_INLINE std::uint32_t set_up(const FrameTask& task, const std::uint32_t* indices, int k) {
    const auto t = load<G>(task.bins.triangles(), indices);
    const BoxLanes boxes(t, task.region);
    const Area area = area_of(t);
    flat |= mask_bits(store_lines(t, area, task.region.x0, sample<G>(boxes.y0), line, k)) << k;
    return store_vector(t, boxes, area, task, indices, k);
  }

  HWY_INLINE void draw(const FrameTask& task, int k, const ScreenTriangle& triangle) const {
    const PixelBox in_region = box(k);
    fill_spans(task, *this, k, triangle.payload, [&](auto&& span) {
      if (flat >> k & 1)
        for_each_span(orient(triangle), in_region, span);
      else
        for_each_line_span(line, k, task.region.x0, in_region, span);
    });
  }
};

void draw_spans_in_frame(const FrameTask& task) {
  task.bins.fine() ? draw_in_batches<FrameSpans<Fine>>(task) : draw_in_batches<FrameSpans<Coarse>>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_spans, draw_spans_in_frame)
#endif

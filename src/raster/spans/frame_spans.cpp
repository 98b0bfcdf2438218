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
#include "raster/fill_counts.h"
#include "raster/frame_lanes-inl.h"
#include "raster/kernels.h"
#include "raster/spans/edge_walk.h"
#include "raster/spans/line_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Fills the spans for which for_each(span) calls span(y, begin, end). Those with begin >= end are empty.
template <typename ForEach>
HWY_INLINE void fill_spans(const FrameTask& task, const BoxDepth& z, std::uint32_t payload,
                           ForEach&& for_each) {
  count(Part::frame_spans);
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_NEON  // the compiler's loop is shorter than 4 lanes of ours
  for_each([&](int y, int begin, int end) {
    const FrameRow row(task.frame, y);
    for (int x = begin, next; x < end; x = next) {
      const int cell = x & -kDepthCell;
      next = std::min(end, cell + kDepthCell);
      fill_span(row.depth + cell, row.payload + cell, x - cell, next - cell, z.in_cell(x, y), z.zx, payload);
    }
  });
#else
  const V lane = hn::Iota(D{}, 0), z_in_vector = hn::Mul(lane, set(z.zx)), colour = set(payload);
  const V z_step = set(static_cast<std::uint32_t>(kLanes) * z.zx);
  const auto every = hn::Eq(lane, lane);
  for_each([&](int y, int begin, int end) {
    const FrameRow row(task.frame, y);
    for (int x = begin, part_end; x < end; x = part_end) {  // a part lies in one depth cell
      const int cell = x & -kDepthCell;
      part_end = std::min(end, cell + kDepthCell);
      const std::uint32_t z_in_cell = z.in_cell(x, y);
      const auto z_at = [&](int at) {
        return hn::Add(set(z_in_cell + static_cast<std::uint32_t>(at - cell) * z.zx), z_in_vector);
      };
      if (x + kLanes <= part_end) {
        V z_here = z_at(x);
        for (; x + kLanes <= part_end; x += kLanes, z_here = hn::Add(z_here, z_step))
          write(row.depth + x, row.payload + x, every, z_here, colour);
      }
      if (x == part_end) continue;
      const int at = vector_at(x, task.area.x1);
      write(row.depth + at, row.payload + at, between(x, hn::Add(lane, hn::Set(D{}, at)), part_end), z_at(at),
            colour);
    }
  });
#endif
}

struct FrameSpans : FrameBatch {
  BatchLine line[3];
  std::uint32_t flat = 0;  // bit k: triangle k has too flat a line, and is walked by integers
};

// Sets up a vector of triangles as entries k … of the batch.
HWY_INLINE std::uint32_t set_up_vector(const FrameTask& task, const std::uint32_t* indices, FrameSpans& out,
                                       int k) {
  const TriangleLanes t = load(task.bins.triangles(), indices);
  const BoxLanes box(t.x, t.y, task.area);
  const Area area = area_of(t);
  const V32 first_sample = hn::Add(hn::ShiftLeft<kSubBits>(box.y0), set32(kHalf));
  out.flat |= mask_bits(store_lines(t, area, task.area.x0, first_sample, out.line, k)) << k;
  return out.store_vector(t, box, area, task.bins.triangles(), indices, k);
}

// Draws triangle k of a batch.
HWY_INLINE void draw(const FrameTask& task, const FrameSpans& batch, int k, const ScreenTriangle& triangle) {
  const PixelBox box = batch.box(k);
  fill_spans(task, BoxDepth(batch.plane(k), box), triangle.payload, [&](auto&& span) {
    if (batch.flat >> k & 1)
      for_each_span(orient(triangle), box, span);
    else
      for_each_line_span(batch.line, k, task.area.x0, box, span);
  });
}

void draw_spans_in_frame(const FrameTask& task) {
  draw_in_batches<FrameSpans>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_spans, draw_spans_in_frame)
#endif

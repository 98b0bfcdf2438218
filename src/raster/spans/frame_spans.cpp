// Fills triangles by their spans, in the frame itself. Triangles are set up one per lane; their spans are
// filled a vector of pixels at a time.
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

// Draws a triangle by its spans.
inline void draw_spans(const FrameTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  fill_spans(task, BoxDepth(make_depth(t), box), triangle.payload,
             [&](auto&& span) { for_each_span(t, box, span); });
}

struct LineBatch;

#if HWY_TARGET != HWY_SCALAR

// A batch of triangles, set up for the spans of an area.
struct alignas(64) LineBatch {
  BatchLine line[3];
  std::int64_t gx[kBatch], gy[kBatch], origin[kBatch];  // the DepthPlane
  std::int32_t zx[kBatch], zy[kBatch];
  std::int32_t payload[kBatch];
  std::int32_t x0[kBatch], x1[kBatch], y0[kBatch], y1[kBatch];  // the box
};

// Sets up a vector of triangles, from triangles[indices[k]] on, as entries k … of the batch.
HWY_INLINE BatchBits set_up_vector(const FrameTask& task, const std::uint32_t* indices, LineBatch& out,
                                   int k) {
  const D64 d;
  const TriangleLanes t = load(task.bins.triangles(), indices + k);
  const BoxLanes box(t.x, t.y, task.area);
  const Area area = area_of(t);
  const V32 first_sample = hn::Add(hn::ShiftLeft<kSubBits>(box.y0), set32(kHalf));
  const auto flat = store_lines(t, area, task.area.x0, first_sample, out.line, k);
  const DepthLanes depth = depth_lanes(t, area, 0, 0);
  hn::Store(depth.gx, d, out.gx + k), hn::Store(depth.gy, d, out.gy + k);
  hn::Store(depth.start, d, out.origin + k);
  store(depth.x, out.zx + k), store(depth.y, out.zy + k), store(t.payload, out.payload + k);
  const std::uint32_t drawn = store_box(box, area, out, k);
  return {drawn, drawn & mask_bits(hn::Or(flat, hn::Not(depth.exact)))};
}

// Draws triangle k of a batch.
HWY_INLINE void draw(const FrameTask& task, const LineBatch& batch, int k) {
  const PixelBox box{batch.x0[k], batch.y0[k], batch.x1[k], batch.y1[k]};
  const int left = task.area.x0;  // the lines' pixels are relative to it
  const auto bits = [k](const auto& lanes) { return static_cast<std::uint64_t>(lanes[k]); };
  const DepthPlane plane{bits(batch.gx), bits(batch.gy), bits(batch.origin),
                         static_cast<std::uint32_t>(batch.zx[k]), static_cast<std::uint32_t>(batch.zy[k])};
  fill_spans(task, BoxDepth(plane, box), static_cast<std::uint32_t>(batch.payload[k]), [&](auto&& span) {
    constexpr int kFar = kMaxImageSide;
    std::int64_t at[3], step[3];
    int is_left[3], is_right[3];
    for (int i = 0; i < 3; ++i) {
      const BatchLine& line = batch.line[i];
      at[i] = line.at[k], step[i] = line.step[k], is_left[i] = line.is_left[k],
      is_right[i] = line.is_right[k];
    }
    for (int y = box.y0; y < box.y1; ++y) {
      int begin = box.x0 - left, end = box.x1 - left;
      for (int i = 0; i < 3; ++i) {  // no branches: sides are hard to predict
        const auto pixel = static_cast<int>(at[i] >> kUnitBits);
        begin = std::max(begin, pixel & is_left[i]);
        end = std::min(end, (pixel & is_right[i]) | (kFar & ~is_right[i]));
        at[i] += step[i];
      }
      span(y, begin + left, end + left);
    }
  });
}

#endif

void draw_spans_in_frame(const FrameTask& task) {
  draw_in_batches<LineBatch>(
      task, [&](const ScreenTriangle& triangle, const PixelBox& box) { draw_spans(task, triangle, box); });
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_spans, draw_spans_in_frame)
#endif

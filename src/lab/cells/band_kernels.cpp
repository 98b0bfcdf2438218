#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/cells/band_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/kernel_table.h"
#include "lab/cells/band_kernels.h"
#include "lab/tiled_spans/tiled_spans_setup-inl.h"
#include "raster/scanline/scanline_band-inl.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

struct LineBatch;

#if HWY_TARGET == HWY_SCALAR

// Steps edges and depth along the rows of the box.
inline void draw_edges(const BandTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  const Edge edge[3] = {make_edge(t, 0), make_edge(t, 1), make_edge(t, 2)};
  const DepthPlane plane = make_depth(t);
  const auto step = [&](int i) { return std::int64_t{edge[i].a} * kSub; };
  for (int y = box.y0; y < box.y1; ++y) {
    std::uint32_t* const depth = task.frame.depth + y * task.frame.stride;
    std::uint32_t* const payload = task.frame.payload + y * task.frame.stride;
    // Depth is re-based in each cell (rule 6).
    for (int x = box.x0, end; x < box.x1; x = end) {
      end = std::min(box.x1, (x / kDepthCell + 1) * kDepthCell);
      std::int64_t e0 = edge[0].at(x, y), e1 = edge[1].at(x, y), e2 = edge[2].at(x, y);
      std::uint32_t z = plane.at(x, y);
      for (; x < end; ++x) {
        if (e0 >= 0 && e1 >= 0 && e2 >= 0 && z < depth[x]) depth[x] = z, payload[x] = triangle.payload;
        e0 += step(0), e1 += step(1), e2 += step(2), z += plane.zx;
      }
    }
  }
}

#else

// Tests all pixels of the box, a vector at a time.
inline void draw_edges(const BandTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const D d;
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  const BandDepth plane(make_depth(t), box);
  const V lane = hn::Iota(d, 0), z_in_vector = hn::Mul(lane, set(plane.zx)), colour = set(triangle.payload);
  const Edge edge[3] = {make_edge(t, 0), make_edge(t, 1), make_edge(t, 2)};
  V in_vector[3];
  for (int i = 0; i < 3; ++i) in_vector[i] = hn::Mul(lane, hn::Set(d, edge[i].a));
  // A shifted value (rule 5) fits int32 once it is clamped. Over a vector it changes by less than 2^27, so
  // its sign stays.
  const auto in_int32 = [](std::int64_t value) {
    constexpr std::int64_t kLimit = 1 << 30;
    return static_cast<std::int32_t>(std::clamp(value >> kSubBits, -kLimit, kLimit));
  };
  const int first = box.x0 & -kLanes;
  for (int y = box.y0; y < box.y1; ++y) {
    const FrameRow row(task.frame, y);
    std::int64_t value[3] = {edge[0].at(first, y), edge[1].at(first, y), edge[2].at(first, y)};
    for (int x = first; x < box.x1; x += kLanes) {
      const int at = vector_at(x, task.area.x1), moved = at - x;
      V outside = hn::Zero(d);
      for (int i = 0; i < 3; ++i) {
        const std::int64_t step = std::int64_t{edge[i].a} * kSub;
        outside = hn::Or(outside, hn::Add(in_vector[i], hn::Set(d, in_int32(value[i] + moved * step))));
        value[i] += kLanes * step;
      }
      const auto from_cell = static_cast<std::uint32_t>(at - (x & -kDepthCell));
      const V z = hn::Add(set(plane.in_cell(x, y) + from_cell * plane.zx), z_in_vector);
      // A moved vector may begin in the previous depth cell, whose pixels are drawn already.
      const int begin = std::max(x, box.x0) - at;
      const auto inside = hn::And(hn::Gt(outside, hn::Set(d, -1)), hn::Gt(lane, hn::Set(d, begin - 1)));
      write(row.depth + at, row.payload + at, inside, z, colour);
    }
  }
}

// A batch of triangles, set up for the spans of a band.
struct alignas(64) LineBatch {
  BatchLine line[3];
  std::int64_t gx[kBatch], gy[kBatch], origin[kBatch];  // the DepthPlane
  std::int32_t zx[kBatch], zy[kBatch];
  std::int32_t payload[kBatch];
  std::int32_t x0[kBatch], x1[kBatch], y0[kBatch], y1[kBatch];  // the box
};

// Sets up a vector of triangles, from triangles[indices[k]] on, as entries k … of the batch.
HWY_INLINE BatchBits set_up_vector(const BandTask& task, const std::uint32_t* indices, LineBatch& out,
                                   int k) {
  const D64 d;
  const TriangleLanes t = load(task.bins.triangles(), indices + k);
  const BoxLanes box = box_lanes(task, t);
  const Area area = area_of(t);
  const V32 first_sample = hn::Add(hn::ShiftLeft<kSubBits>(box.y0), set32(kHalf));
  const auto flat = store_lines(t, area, 0, first_sample, out.line, k);
  const DepthLanes depth = depth_lanes(t, area, 0, 0);
  hn::Store(depth.gx, d, out.gx + k), hn::Store(depth.gy, d, out.gy + k);
  hn::Store(depth.start, d, out.origin + k);
  store(depth.x, out.zx + k), store(depth.y, out.zy + k), store(t.payload, out.payload + k);
  const std::uint32_t drawn = store_box(box, area, out, k);
  return {drawn, drawn & mask_bits(hn::Or(flat, hn::Not(depth.exact)))};
}

// Draws triangle k of a batch.
HWY_INLINE void draw(const BandTask& task, const LineBatch& batch, int k) {
  const PixelBox box{batch.x0[k], batch.y0[k], batch.x1[k], batch.y1[k]};
  const auto bits = [k](const auto& lanes) { return static_cast<std::uint64_t>(lanes[k]); };
  const DepthPlane plane{bits(batch.gx), bits(batch.gy), bits(batch.origin),
                         static_cast<std::uint32_t>(batch.zx[k]), static_cast<std::uint32_t>(batch.zy[k])};
  fill_spans(task, BandDepth(plane, box), static_cast<std::uint32_t>(batch.payload[k]), [&](auto&& span) {
    std::int64_t at[3];
    for (int i = 0; i < 3; ++i) at[i] = batch.line[i].at[k];
    for (int y = box.y0; y < box.y1; ++y) {
      int begin = box.x0, end = box.x1;
      for (int i = 0; i < 3; ++i) {
        const auto pixel = static_cast<int>(at[i] >> kUnitBits);
        if (batch.line[i].is_left[k]) begin = std::max(begin, pixel);
        if (batch.line[i].is_right[k]) end = std::min(end, pixel);
        at[i] += batch.line[i].step[k];
      }
      span(y, begin, end);
    }
  });
}

#endif

void draw_band_in_spans(const BandTask& task) {
  draw_band_by<LineBatch>(
      task, [&](const ScreenTriangle& triangle, const PixelBox& box) { draw_spans(task, triangle, box); });
}

void draw_band_in_edges(const BandTask& task) {
  draw_band_by<NarrowBatch>(
      task, [&](const ScreenTriangle& triangle, const PixelBox& box) { draw_edges(task, triangle, box); });
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(BandKernel, lab::band_spans_kernel, draw_band_in_spans)
EDGEWISE_DEFINE_KERNEL(BandKernel, lab::band_edges_kernel, draw_band_in_edges)
#endif

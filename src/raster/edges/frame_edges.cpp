// Tests the pixels of triangles' boxes by edge functions, in the frame itself. Narrow triangles are set up
// one per lane, wide ones one by one.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/edges/frame_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/fill_counts.h"
#include "raster/frame_lanes-inl.h"
#include "raster/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

struct NarrowBatch;

#if HWY_TARGET == HWY_SCALAR

// Steps edges and depth along the rows of the box.
inline void draw_edges(const FrameTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  count(Part::frame_edges);
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
inline void draw_edges(const FrameTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const D d;
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  count(Part::frame_edges);
  const BoxDepth plane(make_depth(t), box);
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

// px: a box overlaps at most two cells. On NEON, 32 needs no more instructions than 64 in any scene (counted,
// not timed).
constexpr int kNarrow = HWY_TARGET == HWY_NEON ? 32 : kDepthCell;

// A batch of triangles whose boxes in the band are at most kNarrow px wide.
struct alignas(64) NarrowBatch {
  std::int32_t x0[kBatch], x1[kBatch], y0[kBatch], y1[kBatch];  // the box
  struct Edge {
    std::int32_t first[kBatch];         // at the box's first pixel
    std::int32_t x[kBatch], y[kBatch];  // steps per pixel
  } edge[3];
  struct Depth {
    // In the box's first row, at the first pixel of the cell in which the box begins, and in which it ends.
    std::int32_t left[kBatch], right[kBatch];
    std::int32_t x[kBatch], y[kBatch];
  } depth;
  std::int32_t payload[kBatch];
};

// Edge functions in int32, as in rule 5, but shifted values may exceed 2^30 outside tiles. They are clamped:
// up to 78 px to the side and 32 down, a value changes by at most 110 * 2^23 < 2^30. So a clamped value keeps
// its sign, and does not overflow.
HWY_INLINE V64 clamped_shift(V64 value) {
  const D64 d;
  const V64 limit = hn::Set(d, std::int64_t{1} << 30), shifted = hn::ShiftRight<kSubBits>(value);
  return hn::Min(hn::Max(shifted, hn::Neg(limit)), limit);
}

// Sets up a vector of triangles, from triangles[indices[k]] on, as entries k … of the batch.
HWY_INLINE BatchBits set_up_vector(const FrameTask& task, const std::uint32_t* indices, NarrowBatch& out,
                                   int k) {
  const TriangleLanes t = load(task.bins.triangles(), indices + k);
  const BoxLanes box(t.x, t.y, task.area);
  const Area area = area_of(t);
  const auto sample = [](V32 px) { return hn::Add(hn::ShiftLeft<kSubBits>(px), set32(kHalf)); };
  for (int i = 0; i < 3; ++i) {
    const EdgeLanes edge(t, area, i, sample(box.x0), sample(box.y0));
    store(clamped_shift(edge.value), out.edge[i].first + k);
    store(edge.a, out.edge[i].x + k), store(edge.b, out.edge[i].y + k);
  }
  const DepthLanes depth = depth_lanes(t, area, 0, task.area.y0 & -kDepthCell);
  const V32 rows_down = hn::Mul(depth.y, hn::And(box.y0, set32(kDepthCell - 1)));
  const auto in_cell = [&](V32 x) {
    const V32 cell_sub = hn::ShiftLeft<kSubBits>(hn::And(x, set32(-kDepthCell)));
    const V64 base = shift_right<24>(hn::Add(depth.start, product(depth.gx, cell_sub)));
    return hn::Add(lower(base), rows_down);
  };
  store(in_cell(box.x0), out.depth.left + k), store(in_cell(hn::Sub(box.x1, set32(1))), out.depth.right + k);
  store(depth.x, out.depth.x + k), store(depth.y, out.depth.y + k);
  store(t.payload, out.payload + k);
  const std::uint32_t drawn = store_box(box, area, out, k);
  const std::uint32_t narrow =
      mask_bits(depth.exact) & lower_bits(hn::Lt(hn::Sub(box.x1, box.x0), set32(kNarrow + 1)));
  return {drawn, drawn & ~narrow};
}

// Draws triangle k of a batch, column by column of vectors. A box that two depth cells share has two parts.
HWY_INLINE void draw(const FrameTask& task, const NarrowBatch& batch, int k) {
  count(Part::frame_edges);
  const D d;
  const V lane = hn::Iota(d, 0), colour = hn::Set(d, batch.payload[k]);
  const V zx = hn::Set(d, batch.depth.x[k]), zy = hn::Set(d, batch.depth.y[k]);
  const int x0 = batch.x0[k], x1 = batch.x1[k], y0 = batch.y0[k], y1 = batch.y1[k];
  for (int begin = x0, end; begin < x1; begin = end) {
    const int cell = begin & -kDepthCell;
    end = std::min(x1, cell + kDepthCell);
    const V z_in_cell = hn::Set(d, begin == x0 ? batch.depth.left[k] : batch.depth.right[k]);
    for (int x = begin; x < end; x += kLanes) {
      const int at = vector_at(x, task.area.x1);
      const V px = hn::Add(lane, hn::Set(d, at)), from_box = hn::Sub(px, hn::Set(d, x0));
      const auto in_part = between(begin, px, end);
      V value[3], step[3];
      for (int i = 0; i < 3; ++i) {
        const auto& edge = batch.edge[i];
        value[i] = hn::Add(hn::Set(d, edge.first[k]), hn::Mul(from_box, hn::Set(d, edge.x[k])));
        step[i] = hn::Set(d, edge.y[k]);
      }
      V z = hn::Add(z_in_cell, hn::Mul(hn::Sub(px, hn::Set(d, cell)), zx));
      FrameRow row(task.frame, y0);
      for (int y = y0; y < y1; ++y) {
        const V outside = hn::Or(hn::Or(value[0], value[1]), value[2]);
        write(row.depth + at, row.payload + at, hn::And(in_part, hn::Gt(outside, hn::Set(d, -1))), z, colour);
        for (int i = 0; i < 3; ++i) value[i] = hn::Add(value[i], step[i]);
        z = hn::Add(z, zy);
        row.depth += task.frame.stride, row.payload += task.frame.stride;
      }
    }
  }
}

#endif

void draw_edges_in_frame(const FrameTask& task) {
  draw_in_batches<NarrowBatch>(
      task, [&](const ScreenTriangle& triangle, const PixelBox& box) { draw_edges(task, triangle, box); });
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_edges, draw_edges_in_frame)
#endif

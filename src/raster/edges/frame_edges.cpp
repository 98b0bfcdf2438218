// Tests the pixels of triangles' boxes by edge functions, in the frame itself.
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

struct FrameEdges : FrameBatch {
  struct {
    std::int64_t first[kBatch];         // biased value (rule 4) at the box's first sample
    std::int32_t a[kBatch], b[kBatch];  // steps per sub-unit
  } edge[3];
};

// Sets up a vector of triangles as entries k … of the batch.
HWY_INLINE std::uint32_t set_up_vector(const FrameTask& task, const std::uint32_t* indices, FrameEdges& out,
                                       int k) {
  const TriangleLanes t = load(task.bins.triangles(), indices);
  const BoxLanes box(t.x, t.y, task.area);
  const Area area = area_of(t);
  const auto sample = [](V32 px) { return hn::Add(hn::ShiftLeft<kSubBits>(px), set32(kHalf)); };
  for (int i = 0; i < 3; ++i) {
    const EdgeLanes edge(t, area, i, sample(box.x0), sample(box.y0));
    hn::StoreU(edge.value, D64{}, out.edge[i].first + k);
    store(edge.a, out.edge[i].a + k), store(edge.b, out.edge[i].b + k);
  }
  return out.store_vector(t, box, area, task.bins.triangles(), indices, k);
}

// Shifts an edge value (rule 5), and clamps it to 2^30. In a depth cell and a vector of pixels beside it, 79
// px to the side and 32 down, a value changes by at most 111 * 2^23 < 2^30, so a clamped one keeps its sign,
// and does not overflow.
inline std::int32_t in_int32(std::int64_t value) {
  constexpr std::int64_t kLimit = 1 << 30;
  return static_cast<std::int32_t>(std::clamp(value >> kSubBits, -kLimit, kLimit));
}

// Draws triangle k of a batch, cell by cell of depth (rule 6), and there column by column of vectors.
HWY_INLINE void draw(const FrameTask& task, const FrameEdges& batch, int k, const ScreenTriangle& triangle) {
  count(Part::frame_edges);
  const D d;
  const V lane = hn::Iota(d, 0), colour = set(triangle.payload);
  const PixelBox box = batch.box(k);
  const BoxDepth depth(batch.plane(k), box);
  const V zx = set(depth.zx), zy = hn::Set(d, batch.zy[k]);
  for (int begin = box.x0, end; begin < box.x1; begin = end) {
    const int cell = begin & -kDepthCell;
    end = std::min(box.x1, cell + kDepthCell);
    const V z_in_cell = set(depth.in_cell(begin, box.y0));
    std::int32_t first[3];  // at the part's first sample
    for (int i = 0; i < 3; ++i) {
      const auto& edge = batch.edge[i];
      first[i] = in_int32(edge.first[k] + std::int64_t{edge.a[k]} * kSub * (begin - box.x0));
    }
    for (int x = begin; x < end; x += kLanes) {
      const int at = vector_at(x, task.area.x1);
      const V px = hn::Add(lane, hn::Set(d, at)), from_begin = hn::Sub(px, hn::Set(d, begin));
      const auto in_part = between(begin, px, end);
      V value[3];
      for (int i = 0; i < 3; ++i)
        value[i] = hn::Add(hn::Set(d, first[i]), hn::Mul(from_begin, hn::Set(d, batch.edge[i].a[k])));
      V z = hn::Add(z_in_cell, hn::Mul(hn::Sub(px, hn::Set(d, cell)), zx));
      FrameRow row(task.frame, box.y0);
      for (int y = box.y0; y < box.y1; ++y) {
        const V any_negative = hn::Or(hn::Or(value[0], value[1]), value[2]);
        const auto covered = hn::And(in_part, hn::Gt(any_negative, hn::Set(d, -1)));
        write(row.depth + at, row.payload + at, covered, z, colour);
        for (int i = 0; i < 3; ++i) value[i] = hn::Add(value[i], hn::Set(d, batch.edge[i].b[k]));
        z = hn::Add(z, zy);
        row.depth += task.frame.stride, row.payload += task.frame.stride;
      }
    }
  }
}

void draw_edges_in_frame(const FrameTask& task) {
  draw_in_batches<FrameEdges>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_edges, draw_edges_in_frame)
#endif

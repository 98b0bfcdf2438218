// Tests the pixels of triangles' boxes by edge functions, in the frame itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/edges/frame_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "core/kernel_table.h"
#include "edgewise/contract.h"
#include "raster/frame_lanes-inl.h"
#include "raster/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Shifts an edge value (rule 5), and clamps it to 2^30. In a depth cell and a vector of pixels beside it, 79
// px to the side and 32 down, a value changes by at most 111 * 2^23 < 2^30, so a clamped one keeps its sign,
// and does not overflow.
inline std::int32_t in_int32(std::int64_t value) {
  constexpr std::int64_t kLimit = 1 << 30;
  return static_cast<std::int32_t>(std::clamp(value >> Coarse::kSubBits, -kLimit, kLimit));
}

struct FrameEdges : FrameBatch {
  struct {
    std::int64_t first[kBatch];         // biased value (rule 4) at the box's first sample
    std::int32_t a[kBatch], b[kBatch];  // steps per sub-unit
  } edge[3];

  HWY_INLINE std::uint32_t set_up(const FrameTask& task, const std::uint32_t* indices, int k) {
    const auto t = load<Coarse>(task.bins.triangles(), indices);
    const BoxLanes in_area(t, task.area);
    const Area area = area_of(t);
    for (int i = 0; i < 3; ++i) {
      const EdgeLanes lanes(t, area, i, sample<Coarse>(in_area.x0), sample<Coarse>(in_area.y0));
      hn::StoreU(lanes.value, D64{}, edge[i].first + k);
      store(lanes.a, edge[i].a + k), store(lanes.b, edge[i].b + k);
    }
    return store_vector(t, in_area, area, task.bins.triangles(), indices, k);
  }

  HWY_INLINE void draw(const FrameTask& task, int k, const ScreenTriangle& triangle) const {
    count(Part::frame_edges);
    const PixelBox in_area = box(k);
    const BoxDepth depth(plane(k), in_area);
    for (int x = in_area.x0, end; x < in_area.x1; x = end) {
      end = std::min(in_area.x1, (x & -kDepthCell) + kDepthCell);
      draw_piece(task, k, {x, in_area.y0, end, in_area.y1}, depth, triangle.payload);
    }
  }

 private:
  // Draws the part of the triangle's box that lies in one depth cell (rule 6), column by column of vectors.
  HWY_INLINE void draw_piece(const FrameTask& task, int k, const PixelBox& piece, const BoxDepth& depth,
                             std::uint32_t payload) const {
    const D d;
    const V lane = hn::Iota(d, 0), colour = set(payload), z_right = set(depth.zx), z_down = hn::Set(d, zy[k]);
    const V z_in_cell = set(depth.in_cell(piece.x0, piece.y0)), cell = hn::Set(d, piece.x0 & -kDepthCell);
    std::int32_t first[3];  // at the piece's first sample
    for (int i = 0; i < 3; ++i)
      first[i] = in_int32(edge[i].first[k] + std::int64_t{edge[i].a[k]} * Coarse::kSub * (piece.x0 - x0[k]));
    for (int x = piece.x0; x < piece.x1; x += kLanes) {
      const int at = vector_from(x, task.area.x1);
      const V px = hn::Add(lane, hn::Set(d, at)), from_first = hn::Sub(px, hn::Set(d, piece.x0));
      const auto in_piece = between(x, px, piece.x1);
      V value[3];
      for (int i = 0; i < 3; ++i)
        value[i] = hn::Add(hn::Set(d, first[i]), hn::Mul(from_first, hn::Set(d, edge[i].a[k])));
      V z = hn::Add(z_in_cell, hn::Mul(hn::Sub(px, cell), z_right));
      FrameRow row(task.frame, piece.y0);
      for (int y = piece.y0; y < piece.y1; ++y) {
        const V any_negative = hn::Or(hn::Or(value[0], value[1]), value[2]);
        const auto covered = hn::And(in_piece, hn::Gt(any_negative, hn::Set(d, -1)));
        write(row.depth + at, row.payload + at, covered, z, colour);
        for (int i = 0; i < 3; ++i) value[i] = hn::Add(value[i], hn::Set(d, edge[i].b[k]));
        z = hn::Add(z, z_down);
        row.depth += task.frame.stride, row.payload += task.frame.stride;
      }
    }
  }
};

void draw_edges_in_frame(const FrameTask& task) {
  draw_in_batches<FrameEdges>(task);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(FrameKernel, frame_edges, draw_edges_in_frame)
#endif

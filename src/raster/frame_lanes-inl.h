// What the kernels that draw in the frame itself share: rows of pixels, and batches of triangles.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/lanes-inl.h"
#include "edgewise/contract.h"
#include "raster/kernels.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_FRAME_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FRAME_LANES_INL_H
#undef EDGEWISE_FRAME_LANES_INL_H
#else
#define EDGEWISE_FRAME_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// A row of the frame, as signed integers: vectors compare these faster, and depths have 31 bits.
struct FrameRow {
  std::int32_t *depth, *payload;
  FrameRow(FrameView frame, int y)
      : depth(reinterpret_cast<std::int32_t*>(frame.depth + y * frame.stride)),
        payload(reinterpret_cast<std::int32_t*>(frame.payload + y * frame.stride)) {}
};

// Depth-tests a vector of pixels, and writes those of `covered` that are nearer.
HWY_INLINE void write(std::int32_t* depths, std::int32_t* payloads, hn::Mask<D> covered, V z, V payload) {
  const auto wins = hn::And(covered, hn::Lt(z, hn::LoadU(D{}, depths)));
  replace(depths, wins, z);
  replace(payloads, wins, payload);
}

// The first pixel of the vector from pixel x on, moved left if it would pass the region's right end.
HWY_INLINE int vector_from(int x, int right) {
  return std::min(x, right - kLanes);
}
HWY_INLINE hn::Mask<D> between(int begin, V x, int end) {
  return hn::And(hn::Gt(x, hn::Set(D{}, begin - 1)), hn::Lt(x, hn::Set(D{}, end)));
}
HWY_INLINE V set(std::uint32_t v) {
  return hn::Set(D{}, static_cast<std::int32_t>(v));
}

// A batch of triangles: their boxes in the region, and their depth planes (rule 6). The region lies in one
// row of depth cells. Aligned, so that a vector of entries lies in one cache line.
struct alignas(64) FrameBatch {
  std::int32_t x0[kBatch], y0[kBatch], x1[kBatch], y1[kBatch];
  std::int64_t gx[kBatch];
  std::int64_t origin[kBatch];  // 2^kPlaneBits (1/2 + the depth base of the row's first cell), wrapped
  std::int32_t zx[kBatch], zy[kBatch];
  std::int32_t z0[kBatch];  // depth in the box's first row, at the first pixel of its first cell

  PixelBox box(int k) const { return {x0[k], y0[k], x1[k], y1[k]}; }
  // Depth in row y, at the first pixel of the cell that holds pixel x. Both lie in the box.
  HWY_INLINE std::uint32_t z_in_cell(int k, int x, int y) const {
    const int cell_x = x & -kDepthCell;
    const std::uint32_t down = as_unsigned(zy[k]);
    if (cell_x <= x0[k])  // the box's first cell
      return as_unsigned(z0[k]) + as_unsigned(y - y0[k]) * down;
    const std::uint64_t base =
        as_unsigned(origin[k]) + as_unsigned(gx[k]) * (std::uint64_t{as_unsigned(cell_x)} << kFineBits);
    return static_cast<std::uint32_t>(base >> kPlaneBits) + as_unsigned(y % kDepthCell) * down;
  }

  // Stores a vector of triangles as entries k … Returns the bits of those that are drawn.
  template <class G>
  HWY_INLINE std::uint32_t store_vector(const TriangleLanes64<G>& t, const BoxLanes& boxes, const Area& area,
                                        const FrameTask& task, const std::uint32_t* indices, int k) {
    const D64 d;
    const int cell_y = task.region.y0 & -kDepthCell;
    const DepthLanes<G> depth = depth_lanes(t, area, 0, cell_y);
    store(boxes.x0, x0 + k), store(boxes.y0, y0 + k);
    store(boxes.x1, x1 + k), store(boxes.y1, y1 + k);
    hn::StoreU(depth.gx, d, gx + k), hn::StoreU(hn::ShiftLeft<G::kSpareBits>(depth.start), d, origin + k);
    store(depth.x, zx + k), store(depth.y, zy + k);
    const V row_in_cell = hn::And(boxes.y0, set32(kDepthCell - 1));
    const V64 base =
        hn::Add(depth.start,
                wrapped_product(depth.gx, hn::ShiftLeft<G::kSubBits>(hn::And(boxes.x0, set32(-kDepthCell)))));
    store(hn::Add(lower(shift_right<G::kPlaneBits>(base)), hn::Mul(depth.y, row_in_cell)), z0 + k);
    const std::uint32_t drawn = may_cover(boxes, area);
    for (std::uint32_t left = drawn & ~mask_bits(depth.exact); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left), i = k + lane;
      const DepthPlane exact = make_depth(orient(task.bins.triangles()[indices[lane]]));
      gx[i] = as_signed(exact.gx);
      origin[i] = as_signed(exact.origin + exact.gy * (std::uint64_t{as_unsigned(cell_y)} << kFineBits));
      zx[i] = as_signed(exact.zx), zy[i] = as_signed(exact.zy),
      z0[i] = as_signed(exact.at(x0[i] & -kDepthCell, y0[i]));
    }
    return drawn;
  }

 private:
  static std::uint32_t as_unsigned(std::int32_t v) { return static_cast<std::uint32_t>(v); }
  static std::uint64_t as_unsigned(std::int64_t v) { return static_cast<std::uint64_t>(v); }
  static std::int32_t as_signed(std::uint32_t v) { return static_cast<std::int32_t>(v); }
  static std::int64_t as_signed(std::uint64_t v) { return static_cast<std::int64_t>(v); }
};

// Draws a cell's triangles in submission order. A Batch derives from FrameBatch and has set_up(task, indices,
// k), which sets up a vector of triangles as its entries k …, and draw(task, k, triangle).
template <typename Batch>
HWY_INLINE void draw_in_batches(const FrameTask& task) {
  static_assert(Bins::kIndicesPerSegment <= kBatch);
  const ScreenTriangle* const triangles = task.bins.triangles();
  task.bins.for_each_segment(task.cell, [&](const Bins::Segment& segment) {
    Batch batch;
    std::uint32_t drawn = set_up_batch(segment.indices, [&](const std::uint32_t* padded, int k) {
      return batch.set_up(task, padded + k, k);
    });
    for (; drawn != 0; drawn &= drawn - 1) {
      const int k = std::countr_zero(drawn);
      batch.draw(task, k, triangles[segment.indices[static_cast<std::size_t>(k)]]);
    }
  });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

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

// A triangle's depth plane (rule 6) in a box that lies in one row of depth cells.
class BoxDepth {
 public:
  BoxDepth(const DepthPlane& plane, const PixelBox& box) : zx(plane.zx), zy_(plane.zy) {
    for (int x = box.x0 & -kDepthCell; x < box.x1; x += kDepthCell)
      base_[x / kDepthCell] = plane.base(x, box.y0 & -kDepthCell);
  }
  // Depth at the first pixel of the cell that holds pixel x, in row y.
  std::uint32_t in_cell(int x, int y) const {
    return base_[x / kDepthCell] + static_cast<std::uint32_t>(y % kDepthCell) * zy_;
  }
  const std::uint32_t zx;

 private:
  std::uint32_t zy_;
  std::uint32_t base_[kMaxImageSide / kDepthCell];
};

// Depth-tests a vector of pixels, and writes those of `covered` that are nearer.
HWY_INLINE void write(std::int32_t* depth, std::int32_t* payload, hn::Mask<D> covered, V z, V colour) {
  const auto wins = hn::And(covered, hn::Lt(z, hn::LoadU(D{}, depth)));
  replace(depth, wins, z);
  replace(payload, wins, colour);
}

// The first pixel of the vector from pixel x on, moved left if it would pass the area's right end.
HWY_INLINE int vector_from(int x, int right) {
  return std::min(x, right - kLanes);
}
HWY_INLINE hn::Mask<D> between(int begin, V x, int end) {
  return hn::And(hn::Gt(x, hn::Set(D{}, begin - 1)), hn::Lt(x, hn::Set(D{}, end)));
}
HWY_INLINE V set(std::uint32_t v) {
  return hn::Set(D{}, static_cast<std::int32_t>(v));
}

// A batch of triangles: their boxes in the area, and their depth planes (rule 6).
struct FrameBatch {
  std::int32_t x0[kBatch], y0[kBatch], x1[kBatch], y1[kBatch];
  std::int64_t gx[kBatch], gy[kBatch], origin[kBatch];
  std::int32_t zx[kBatch], zy[kBatch];

  PixelBox box(int k) const { return {x0[k], y0[k], x1[k], y1[k]}; }
  DepthPlane plane(int k) const {
    const auto bits = [](auto v) { return static_cast<std::make_unsigned_t<decltype(v)>>(v); };
    return {bits(gx[k]), bits(gy[k]), bits(origin[k]), bits(zx[k]), bits(zy[k])};
  }

  // Stores a vector of triangles as entries k … Returns the bits of those that are drawn.
  template <class G>
  HWY_INLINE std::uint32_t store_vector(const TriangleLanes64<G>& t, const BoxLanes& in_area,
                                        const Area& area, const ScreenTriangle* triangles,
                                        const std::uint32_t* indices, int k) {
    const D64 d;
    const DepthLanes<G> depth = depth_lanes(t, area, 0, 0);
    store(in_area.x0, x0 + k), store(in_area.y0, y0 + k);
    store(in_area.x1, x1 + k), store(in_area.y1, y1 + k);
    hn::StoreU(depth.gx, d, gx + k), hn::StoreU(depth.gy, d, gy + k),
        hn::StoreU(hn::ShiftLeft<G::kSpareBits>(depth.start), d, origin + k);
    store(depth.x, zx + k), store(depth.y, zy + k);
    const std::uint32_t drawn = may_cover(in_area, area);
    for (std::uint32_t left = drawn & ~mask_bits(depth.exact); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const DepthPlane exact = make_depth(orient(triangles[indices[lane]]));
      gx[k + lane] = static_cast<std::int64_t>(exact.gx), gy[k + lane] = static_cast<std::int64_t>(exact.gy);
      origin[k + lane] = static_cast<std::int64_t>(exact.origin);
      zx[k + lane] = static_cast<std::int32_t>(exact.zx), zy[k + lane] = static_cast<std::int32_t>(exact.zy);
    }
    return drawn;
  }
};

// Draws a cell's triangles in submission order. A Batch derives from FrameBatch and has set_up(task, indices,
// k), which sets up a vector of triangles as its entries k …, and draw(task, k, triangle).
template <typename Batch>
HWY_INLINE void draw_in_batches(const FrameTask& task) {
  const ScreenTriangle* const triangles = task.bins.triangles();
  task.bins.for_each_segment_ahead(task.cell, [&](const Bins::Segment& segment) {
    Batch batch;
    std::uint32_t left = set_up_batch(segment.indices, [&](const std::uint32_t* padded, int k) {
      return batch.set_up(task, padded + k, k);
    });
    for (; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      batch.draw(task, k, triangles[segment.indices[static_cast<std::size_t>(k)]]);
    }
  });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// What the kernels that draw in the frame itself share: rows of pixels, and batches of triangles with one
// triangle per lane.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

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
  const D d;
  const V old = hn::LoadU(d, depth);
  const auto wins = hn::And(covered, hn::Lt(z, old));
#if HWY_TARGET <= HWY_AVX3  // the better the target, the lower its number
  hn::BlendedStore(z, wins, d, depth);
  hn::BlendedStore(colour, wins, d, payload);
#else
  hn::StoreU(hn::IfThenElse(wins, z, old), d, depth);
  hn::StoreU(hn::IfThenElse(wins, colour, hn::LoadU(d, payload)), d, payload);
#endif
}

// The vector of pixels that holds pixel x, moved left if it would pass the area's right end.
HWY_INLINE int vector_at(int x, int right) {
  return std::min(x, right - kLanes);
}
HWY_INLINE hn::Mask<D> between(int begin, V x, int end) {
  return hn::And(hn::Gt(x, hn::Set(D{}, begin - 1)), hn::Lt(x, hn::Set(D{}, end)));
}
HWY_INLINE V set(std::uint32_t v) {
  return hn::Set(D{}, static_cast<std::int32_t>(v));
}

#if HWY_TARGET != HWY_SCALAR

// Stores the boxes as entries k … of a batch. Returns the bits of triangles that are drawn.
template <typename Batch>
HWY_INLINE std::uint32_t store_box(const BoxLanes& box, const Area& area, Batch& out, int k) {
  store(box.x0, out.x0 + k), store(box.x1, out.x1 + k);
  store(box.y0, out.y0 + k), store(box.y1, out.y1 + k);
  return lower_bits(box.filled) & mask_bits(hn::Gt(area.value, hn::Zero(D64{})));
}

#endif

// Calls draw_one(triangle, box) with the triangle's box in the area, unless it is empty.
template <typename DrawOne>
HWY_INLINE void draw_in_area(const FrameTask& task, const ScreenTriangle& triangle, DrawOne&& draw_one) {
  PixelBox box = pixel_box(triangle, task.area.x1, task.area.y1);
  box.x0 = std::max(box.x0, task.area.x0);
  box.y0 = std::max(box.y0, task.area.y0);
  if (!box.empty()) draw_one(triangle, box);
}

// Draws a cell's triangles in submission order: with vectors, those that fit a Batch by draw(task, batch, k),
// the others by draw_one(triangle, box).
template <typename Batch, typename DrawOne>
HWY_INLINE void draw_in_batches(const FrameTask& task, DrawOne&& draw_one) {
  const ScreenTriangle* const triangles = task.bins.triangles();
  task.bins.for_each_segment_ahead(task.cell, [&](const Bins::Segment& segment) {
#if HWY_TARGET == HWY_SCALAR
    for (const std::uint32_t index : segment.indices) draw_in_area(task, triangles[index], draw_one);
#else
    Batch batch;
    const BatchBits bits = set_up_batch(segment.indices, [&](const std::uint32_t* padded, int k) {
      return set_up_vector(task, padded, batch, k);
    });
    for (std::uint32_t left = bits.drawn; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (bits.scalar >> k & 1)
        draw_one(triangles[segment.indices[static_cast<std::size_t>(k)]],
                 PixelBox{batch.x0[k], batch.y0[k], batch.x1[k], batch.y1[k]});
      else
        draw(task, batch, k);
    }
#endif
  });
  clear_upper_halves();
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

// Draws the triangles of one band.
//
// Wide triangles are drawn by their spans. With vectors, narrow ones are tested by edge functions instead.
// Each of their spans would fill only a few vectors, so mispredicted branches and scalar set-up would take
// longer than drawing. They are set up one triangle per lane.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "edgewise/contract.h"
#include "raster/bands.h"
#include "raster/scanline/edge_walk.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_SCANLINE_BAND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_SCANLINE_BAND_INL_H
#undef EDGEWISE_SCANLINE_BAND_INL_H
#else
#define EDGEWISE_SCANLINE_BAND_INL_H
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

// A triangle's depth plane (rule 6) in the part of a band that its box overlaps.
class BandDepth {
 public:
  BandDepth(const DepthPlane& plane, const PixelBox& box) : zx(plane.zx), zy_(plane.zy) {
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

// Fills the spans for which for_each(span) calls span(y, begin, end). Those with begin >= end are empty.
template <typename ForEach>
HWY_INLINE void fill_spans(const BandTask& task, const BandDepth& z, std::uint32_t payload,
                           ForEach&& for_each) {
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
    if (begin >= end) return;
    const FrameRow row(task.frame, y);
    // The depths of the vector at `at`, which may lie left of x, by the plane of x's cell.
    const auto z_in = [&](int x, int at) {
      const auto from_cell = static_cast<std::uint32_t>(at - (x & -kDepthCell));
      return hn::Add(set(z.in_cell(x, y) + from_cell * z.zx), z_in_vector);
    };
    const auto write_masked = [&](int x) {
      const int at = vector_at(x, task.area.x1);
      const auto in_span = between(std::max(begin, x), hn::Add(lane, hn::Set(D{}, at)), end);
      write(row.depth + at, row.payload + at, in_span, z_in(x, at), colour);
    };
    // Only the first and the last vector need a mask.
    const int first = begin & -kLanes, last = (end - 1) & -kLanes;
    write_masked(first);
    for (int x = first + kLanes; x < last;) {
      const int cell_end = std::min(last, (x | (kDepthCell - 1)) + 1);
      for (V z_here = z_in(x, x); x < cell_end; x += kLanes, z_here = hn::Add(z_here, z_step))
        write(row.depth + x, row.payload + x, every, z_here, colour);
    }
    if (first < last) write_masked(last);
  });
#endif
}

// Draws a triangle by its spans.
inline void draw_spans(const BandTask& task, const ScreenTriangle& triangle, const PixelBox& box) {
  const Oriented t = orient(triangle);
  if (t.area == 0) return;
  fill_spans(task, BandDepth(make_depth(t), box), triangle.payload,
             [&](auto&& span) { for_each_span(t, box, span); });
}

struct NarrowBatch;

#if HWY_TARGET != HWY_SCALAR

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

// The boxes of a vector of triangles in a band.
struct BoxLanes {
  V32 x0, x1, y0, y1;
};
HWY_INLINE BoxLanes box_lanes(const BandTask& task, const TriangleLanes& t) {
  const auto [x0, x1] = sample_range(t.x, task.area.x0, task.area.x1 - task.area.x0);
  const auto [y0, y1] = sample_range(t.y, task.area.y0, task.area.y1 - task.area.y0);
  const V32 left = set32(task.area.x0), top = set32(task.area.y0);
  return {hn::Add(x0, left), hn::Add(x1, left), hn::Add(y0, top), hn::Add(y1, top)};
}
// The bits of a mask of 32-bit lanes, of which the lower one of each pair counts.
HWY_INLINE std::uint32_t lower_bits(hn::Mask<D32> mask) {
  const D64 d;
  return mask_bits(hn::Lt(hn::ShiftLeft<32>(as64(hn::VecFromMask(D32{}, mask))), hn::Zero(d)));
}
// Stores the boxes as entries k … of a batch. Returns the bits of triangles that are drawn.
template <typename Batch>
HWY_INLINE std::uint32_t store_box(const BoxLanes& box, const Area& area, Batch& out, int k) {
  store(box.x0, out.x0 + k), store(box.x1, out.x1 + k);
  store(box.y0, out.y0 + k), store(box.y1, out.y1 + k);
  return lower_bits(hn::And(hn::Lt(box.x0, box.x1), hn::Lt(box.y0, box.y1))) &
         mask_bits(hn::Gt(area.value, hn::Zero(D64{})));
}

// Sets up a vector of triangles, from triangles[indices[k]] on, as entries k … of the batch.
HWY_INLINE BatchBits set_up_vector(const BandTask& task, const std::uint32_t* indices, NarrowBatch& out,
                                   int k) {
  const D64 d;
  const D32 d32;
  const V32 zero = hn::Zero(d32);
  const TriangleLanes t = load(task.bins.triangles(), indices + k);
  const BoxLanes box = box_lanes(task, t);
  const auto [x0, x1, y0, y1] = box;
  const Area area = area_of(t);
  const V32 flip = lower(area.flip);
  const V32 sample_x = hn::Add(hn::ShiftLeft<kSubBits>(x0), set32(kHalf)),
            sample_y = hn::Add(hn::ShiftLeft<kSubBits>(y0), set32(kHalf));
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const V32 a = flipped(hn::Sub(t.y[i], t.y[j]), flip), b = flipped(hn::Sub(t.x[j], t.x[i]), flip);
    const auto top_left = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
    const V64 bias = hn::AndNot(as64(hn::VecFromMask(d32, top_left)), hn::Set(d, 1));
    const V64 value = hn::Add(product(a, hn::Sub(sample_x, t.x[i])), product(b, hn::Sub(sample_y, t.y[i])));
    store(clamped_shift(hn::Sub(value, bias)), out.edge[i].first + k);
    store(a, out.edge[i].x + k), store(b, out.edge[i].y + k);
  }
  const DepthLanes depth = depth_lanes(t, area, 0, task.area.y0 & -kDepthCell);
  const V32 rows_down = hn::Mul(depth.y, hn::And(y0, set32(kDepthCell - 1)));
  const auto in_cell = [&](V32 x) {
    const V32 cell_sub = hn::ShiftLeft<kSubBits>(hn::And(x, set32(-kDepthCell)));
    const V64 base = shift_right<24>(hn::Add(depth.start, product(depth.gx, cell_sub)));
    return hn::Add(lower(base), rows_down);
  };
  store(in_cell(x0), out.depth.left + k), store(in_cell(hn::Sub(x1, set32(1))), out.depth.right + k);
  store(depth.x, out.depth.x + k), store(depth.y, out.depth.y + k);
  store(t.payload, out.payload + k);
  const std::uint32_t drawn = store_box(box, area, out, k);
  const std::uint32_t narrow =
      mask_bits(depth.exact) & lower_bits(hn::Lt(hn::Sub(x1, x0), set32(kNarrow + 1)));
  return {drawn, drawn & ~narrow};
}

// Draws triangle k of a batch, column by column of vectors. A box that two depth cells share has two parts.
HWY_INLINE void draw(const BandTask& task, const NarrowBatch& batch, int k) {
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

// Calls draw_one(triangle, box) with the triangle's box in the area, unless it is empty.
template <typename DrawOne>
HWY_INLINE void draw_in_area(const BandTask& task, const ScreenTriangle& triangle, DrawOne&& draw_one) {
  PixelBox box = pixel_box(triangle, task.area.x1, task.area.y1);
  box.x0 = std::max(box.x0, task.area.x0);
  box.y0 = std::max(box.y0, task.area.y0);
  if (!box.empty()) draw_one(triangle, box);
}

// Draws a band's triangles in submission order: with vectors, those that fit a Batch by draw(task, batch, k),
// the others by draw_one(triangle, box).
template <typename Batch, typename DrawOne>
HWY_INLINE void draw_band_by(const BandTask& task, DrawOne&& draw_one) {
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

// Sets triangles up for one tile, a vector at a time, and finds a triangle's spans there, a vector of rows at
// a time: one 64-bit lane per row, with 32-bit values in its upper half.
#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <type_traits>

#include "edgewise/contract.h"
#include "raster/kernels.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"
#include "raster/spans/line_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_SPAN_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_SPAN_ROWS_INL_H
#undef EDGEWISE_SPAN_ROWS_INL_H
#else
#define EDGEWISE_SPAN_ROWS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// A batch of triangles, set up for one tile. Rows and pixels are relative to the tile.
template <class G>
struct SpanBatch {
  BatchLine<G> line[3];
  struct {
    std::int32_t first[kBatch];  // at the first pixel of the first row
    std::int32_t x[kBatch], y[kBatch];
  } depth;
  std::int32_t nearest[kBatch];  // lower bound of the depth of the triangle's pixels
  std::int32_t payload[kBatch];
  std::int32_t x0[kBatch], x1[kBatch], y0[kBatch], y1[kBatch];  // the box
  std::uint32_t by_integers;  // bit k: triangle k has too flat a line, or too steep a depth plane
};

// Sets up a vector of triangles as entries k … of the batch. Returns the bits of those that are drawn.
template <class G>
HWY_INLINE std::uint32_t set_up_vector(const TileTask& task, const std::uint32_t* indices, SpanBatch<G>& out,
                                       int k) {
  const auto t = load<G>(task.bins.triangles(), indices);
  const BoxLanes box(t, task.box());
  const V32 x0 = hn::Sub(box.x0, set32(task.x0)), x1 = hn::Sub(box.x1, set32(task.x0));
  const V32 y0 = hn::Sub(box.y0, set32(task.y0)), y1 = hn::Sub(box.y1, set32(task.y0));
  const Area area = area_of(t);
  const auto flat = store_lines(t, area, task.x0, sample<G>(y0, task.y0), out.line, k);
  const DepthLanes<G> depth = depth_lanes(t, area, task.x0 & -kDepthCell, task.y0 & -kDepthCell);
  out.by_integers |= mask_bits(hn::Or(flat, hn::Not(depth.exact))) << k;
  const V32 first = depth.at(set32(task.x0 % kDepthCell), hn::Add(y0, set32(task.y0 % kDepthCell)));
  store(first, out.depth.first + k);
  store(depth.x, out.depth.x + k), store(depth.y, out.depth.y + k);
  const V32 at_box = hn::Add(first, hn::Mul(depth.x, x0));
  const auto fall = [](V32 step, V32 begin, V32 end) {
    return hn::Mul(hn::Min(step, hn::Zero(D32{})), hn::Sub(hn::Sub(end, begin), set32(1)));
  };
  const V32 in_box = hn::Add(at_box, hn::Add(fall(depth.x, x0, x1), fall(depth.y, y0, y1)));
  store(hn::IfThenElse(depth.is_flat(), in_box, nearest_vertex(t)), out.nearest + k);
  store(t.payload, out.payload + k);
  store(x0, out.x0 + k), store(x1, out.x1 + k);
  store(y0, out.y0 + k), store(y1, out.y1 + k);
  return may_cover(box, area);
}

constexpr int kRows = kLanes64;
constexpr int kRowsLog2 = std::countr_zero(static_cast<unsigned>(kRows));

#if HWY_TARGET != HWY_SCALAR

// Moves the selected 64-bit lanes to the front. The lanes behind them are unspecified. Compress() of
// Highway 1.0.3 uses a table that GCC copies to the stack at every call, except for 32-bit lanes with
// AVX-512.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE V64 selected_first(V64 v, hn::Mask<D64> mask) {
  const V32 both_halves = hn::DupOdd(lower(hn::VecFromMask(D64{}, mask)));
  return as64(hn::Compress(lower(v), hn::MaskFromVec(both_halves)));
}
#else
constexpr auto kLanesOfRowMask = [] {
  struct {
    std::uint8_t half[1 << kRows][2 * kRows];
  } table{};
  for (int mask = 0; mask < 1 << kRows; ++mask) {
    int count = 0;
    for (int lane = 0; lane < kRows; ++lane)
      if (mask >> lane & 1)
        for (const int half : {2 * lane, 2 * lane + 1})
          table.half[mask][count++] = static_cast<std::uint8_t>(half);
  }
  return table;
}();
HWY_INLINE V64 selected_first(V64 v, hn::Mask<D64> mask) {
  const D32 d;
  const hn::Rebind<std::uint8_t, D32> d8;
  const V32 halves = hn::PromoteTo(d, hn::LoadU(d8, kLanesOfRowMask.half[mask_bits(mask)]));
  return as64(hn::TableLookupLanes(lower(v), hn::IndicesFromVec(d, halves)));
}
#endif

// The ends of the spans of triangle k of a batch, for a vector of rows of the tile from `first_row` on.
template <class G>
class RowLanes {
 public:
  HWY_INLINE RowLanes(const SpanBatch<G>& batch, int k, int first_row)
      : zy_(set32(batch.depth.y[k])),
        first_row_(set32(batch.y0[k])),
        rows_(set32(batch.y1[k] - batch.y0[k])) {
    const D64 d;
    const V64 lane = hn::Add(hn::Iota(d, 0), hn::Set(d, first_row - batch.y0[k]));
    for (int i = 0; i < 3; ++i) {
      const auto& line = batch.line[i];
      const V64 step = hn::Set(d, line.step[k]);
      at_[i] = hn::Add(hn::Set(d, line.at[k]), wrapped_product(step, lower(lane)));
      stride_[i] = hn::ShiftLeft<kRowsLog2>(step);
      is_left_[i] = set32(line.is_left[k]), is_right_[i] = set32(line.is_right[k]);
      if constexpr (std::is_same_v<G, Fine>) {
        const V64 first = hn::Set(d, line.value[k] >> G::kSubBits);  // rule 5
        value_[i] = hn::Add(first, product(set32(line.down[k]), lower(lane)));
        value_stride_[i] = hn::Set(d, std::int64_t{line.down[k]} * kRows);
        to_right_[i] = set32(line.to_right[k]);
      }
    }
    const V32 from_first = lower(hn::ShiftLeft<32>(lane));
    row = hn::Add(first_row_, from_first);
    z = hn::Add(set32(batch.depth.first[k]), hn::Mul(zy_, from_first));
    find_ends();
  }
  HWY_INLINE void next() {
    for (int i = 0; i < 3; ++i) {
      at_[i] = hn::Add(at_[i], stride_[i]);
      if constexpr (std::is_same_v<G, Fine>) value_[i] = hn::Add(value_[i], value_stride_[i]);
    }
    row = hn::Add(row, set32(kRows));
    z = hn::Add(z, hn::ShiftLeft<kRowsLog2>(zy_));
    find_ends();
  }
  V32 row, z;      // row in the tile; depth at the row's first pixel
  V32 begin, end;  // px in the tile; end = 0 for rows outside the triangle's box

 private:
  HWY_INLINE void find_ends() {
    const V32 size = set32(kMaxTile);
    begin = hn::Zero(D32{}), end = size;
    for (int i = 0; i < 3; ++i) {
      V32 pixel = hn::ShiftRight<kUnitBits - 32>(lower(at_[i]));
      if constexpr (std::is_same_v<G, Fine>) {
        const V64 value = hn::Add(value_[i], product(upper(as64(pixel)), to_right_[i]));
        pixel = hn::Sub(pixel, hn::ShiftRight<31>(lower(value)));
      }
      begin = hn::Max(begin, hn::And(pixel, is_left_[i]));
      end = hn::Min(end, hn::IfVecThenElse(is_right_[i], pixel, size));
    }
    const V32 from_first = hn::Sub(row, first_row_);
    end = hn::IfThenElseZero(hn::And(hn::Gt(from_first, set32(-1)), hn::Lt(from_first, rows_)), end);
  }
  V64 at_[3], stride_[3], value_[3], value_stride_[3];
  V32 is_left_[3], is_right_[3], to_right_[3], zy_, first_row_, rows_;
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

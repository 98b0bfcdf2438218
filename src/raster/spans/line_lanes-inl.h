// The edges of a vector of triangles as lines that are stepped row by row, to find spans in a region of a
// frame: a tile of 64 x 64 px, or 32 rows of any width.
//
// Where a row's sample lies at height s, the edge from p to q is at x = p.x + (s - p.y) dx / dy. The first
// pixel whose sample is not left of it is the ceiling of v = x - 1/2 px. A span goes from the largest of
// these pixels of the left edges to the smallest of the right ones, over the rows whose samples lie in the
// triangle's box. It is half open in both directions, which is the top-left rule (rule 4). Past its end, an
// edge's line does not cut into the triangle, so every row uses all edges.
//
// Binary fractions with enough bits walk an edge exactly. On the coarse grid (core/grid.h), v is a multiple
// of 1 / (256 |dy|) >= 2^-31 px, or 2^12 units of 2^-43 px. Let u be the sum of a start and some steps, less
// than 1500 units away from v. Then w = u + 1 px - 2^11 units lies between v + 1 px - 2^12 units and v + 1
// px, and floor(w) is the ceiling of v. On the fine grid, floor(w) may be the pixel before that: the edge
// function (rule 4) at its sample decides.
//
// Doubles are precise enough for that:
// - Steps per row below 2^12 px = 2^55 units are off by 2^-52 of that, and 1 for rounding: over 63 rows,
//   below 575 units.
// - A start within 2^18 + 2^15 px (2^61.2 units) of the edge's vertex is off by 3/2 2^-52 of that: below 870.
//   A line that starts farther away does not reach the region in its rows, not even with its start clamped to
//   2^18 + 2^17 px.
// - Start, steps and the at most 2^15 px from vertex to region sum up to less than 2^20 px = 2^63 units.
// An edge that moves 2^12 px per row or more, but is not horizontal, crosses at most 8 rows. The spans of its
// triangle are found by integer divisions (raster/spans/integer_spans.h). proofs/spans.smt2 proves these
// claims.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "edgewise/contract.h"
#include "raster/simd/depth_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_LINE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_LINE_LANES_INL_H
#undef EDGEWISE_LINE_LANES_INL_H
#else
#define EDGEWISE_LINE_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

constexpr int kUnitBits = 43;                              // a unit is 2^-43 px
constexpr double kMaxStep = 0x1p55, kMaxStart = 0x1.8p61;  // units per row; units

// Converts doubles to integers, both in units; off by at most 1.
HWY_INLINE V64 to_units(hn::Vec<F64> v) {
  const D64 d;
#if HWY_TARGET <= HWY_AVX3
  return hn::ConvertTo(d, v);
#else  // ConvertTo is slow here: round the upper and the lower 32 bits by adding a number whose ulp is 1
  const F64 df;
  const auto rounder = hn::Set(df, 0x1.8p52);
  const auto bits = [&](hn::Vec<F64> sum) { return hn::Sub(hn::BitCast(d, sum), hn::BitCast(d, rounder)); };
  const auto high = hn::Add(hn::Mul(v, hn::Set(df, 0x1p-32)), rounder);
  const auto rest = hn::Sub(v, hn::Mul(hn::Sub(high, rounder), hn::Set(df, 0x1p32)));
  return hn::Add(hn::ShiftLeft<32>(bits(high)), bits(hn::Add(rest, rounder)));
#endif
}

// The lines of a vector of edges.
struct LineLanes {
  V64 at;                 // on the first row, in units: w above, whose floor is the first pixel
  V64 step;               // per row
  V32 is_left, is_right;  // edges on that side of the triangle: -1, both halves; 0 for both if horizontal
  hn::Mask<D64> flat;     // too flat: needs the integer walk
};
template <class G>
HWY_INLINE LineLanes line_lanes(V32 px, V32 py, V32 qx, V32 qy, V32 flip, V32 first_sample) {
  const D64 d;
  const F64 df;
  const V32 zero = hn::Zero(D32{}), dx = hn::Sub(qx, px), dy = hn::Sub(qy, py);
  // A horizontal edge bounds no row. The large divisor keeps it from being marked as too flat.
  const V32 not_zero_dy = hn::IfThenElse(hn::Eq(dy, zero), set32(G::kGuardSub), dy);
  const auto as_double = [](V64 v) { return hn::ConvertTo(F64{}, v); };
  constexpr int kPerSubBits = kUnitBits - G::kSubBits;
  const auto units_per_sub = hn::Set(df, double{std::int64_t{1} << kPerSubBits});
  const auto per_sub = hn::Div(units_per_sub, as_double(product(not_zero_dy, set32(1))));
  const auto step = hn::Mul(as_double(product(dx, set32(G::kSub))), per_sub);
  const auto start = hn::Mul(as_double(product(dx, hn::Sub(first_sample, py))), per_sub);
  const auto clamped = [&](hn::Vec<F64> v, double limit) {
    return to_units(hn::Min(hn::Max(v, hn::Set(df, -limit)), hn::Set(df, limit)));
  };
  const V32 from_half = hn::Sub(px, set32(G::kHalf));
  const V64 vertex =  // extends the sign if the shift leaves some of the upper half
      hn::ShiftLeft<kPerSubBits>(kPerSubBits < 32 ? product(from_half, set32(1)) : as64(from_half));
  const V64 ceiling = hn::Set(d, (std::int64_t{1} << kUnitBits) - (std::int64_t{1} << 11));
  // Clockwise on a y-down screen: an edge that goes up is on the left.
  const V32 down = flipped(dy, flip);
  return {hn::Add(clamped(start, kMaxStart), hn::Add(vertex, ceiling)), clamped(step, kMaxStep),
          hn::VecFromMask(D32{}, hn::Lt(down, zero)), hn::VecFromMask(D32{}, hn::Gt(down, zero)),
          hn::RebindMask(d, hn::Ge(hn::Abs(step), hn::Set(df, kMaxStep)))};
}

// A line of each triangle of a batch (LineLanes).
template <class G>
struct BatchLine {
  std::int64_t at[kBatch], step[kBatch];
  std::int32_t is_left[kBatch], is_right[kBatch];
};
// The biased edge value (rule 4) at the sample of the first row and column; its steps per sub-unit. For a
// right edge they are negated, the value by its complement, so that a sample left of any line has a negative
// value.
template <>
struct BatchLine<Fine> : BatchLine<Coarse> {
  std::int64_t value[kBatch];
  std::int32_t to_right[kBatch], down[kBatch];
};
// Stores the lines of a vector of triangles as entries k … of `out`, relative to pixel column `left`. Returns
// where one is too flat.
template <class G>
HWY_INLINE hn::Mask<D64> store_lines(const TriangleLanes64<G>& t, const Area& area, int left,
                                     V32 first_sample, BatchLine<G> (&out)[3], int k) {
  const D64 d;
  auto flat = hn::FirstN(d, 0);
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const V32 origin = set32(left * G::kSub);
    const LineLanes line = line_lanes<G>(hn::Sub(t.x[i], origin), t.y[i], hn::Sub(t.x[j], origin), t.y[j],
                                         lower(area.flip), first_sample);
    hn::StoreU(line.at, d, out[i].at + k);
    hn::StoreU(line.step, d, out[i].step + k);
    store(line.is_left, out[i].is_left + k), store(line.is_right, out[i].is_right + k);
    if constexpr (std::is_same_v<G, Fine>) {
      const EdgeLanes edge(t, area, i, set32(G::sample(left)), first_sample);
      hn::StoreU(hn::Xor(edge.value, as64(line.is_right)), d, out[i].value + k);
      store(hn::Abs(edge.a), out[i].to_right + k), store(flipped(edge.b, line.is_right), out[i].down + k);
    }
    flat = hn::Or(flat, line.flat);
  }
  return flat;
}

// Calls span(y, begin, end) for each row of triangle k's box, whose first row is that of the lines: the
// triangle covers the box's pixels begin … end - 1, and none if begin >= end. Requires left <= box.x0.
template <class G, typename Span>
HWY_INLINE void for_each_line_span(const BatchLine<G> (&line)[3], int k, int left, const PixelBox& box,
                                   Span&& span) {
  std::int64_t at[3], step[3], value[3];  // copies, which stores of pixels cannot change
  int is_left[3], is_right[3], to_right[3], down[3];
  for (int i = 0; i < 3; ++i) {
    at[i] = line[i].at[k], step[i] = line[i].step[k];
    is_left[i] = line[i].is_left[k], is_right[i] = line[i].is_right[k];
    if constexpr (std::is_same_v<G, Fine>) {
      value[i] = line[i].value[k] >> G::kSubBits;  // rule 5
      to_right[i] = line[i].to_right[k], down[i] = line[i].down[k];
    }
  }
  for (int y = box.y0; y < box.y1; ++y) {
    int begin = box.x0 - left, end = box.x1 - left;
    for (int i = 0; i < 3; ++i) {  // no branches: sides are hard to predict
      auto pixel = static_cast<int>(at[i] >> kUnitBits);
      if constexpr (std::is_same_v<G, Fine>) {
        pixel += (value[i] + std::int64_t{to_right[i]} * pixel < 0);  // the next one if its sample is left
        value[i] += down[i];
      }
      begin = std::max(begin, pixel & is_left[i]);
      end = std::min(end, (pixel & is_right[i]) | (kMaxImageSide & ~is_right[i]));
      at[i] += step[i];
    }
    span(y, begin + left, end + left);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

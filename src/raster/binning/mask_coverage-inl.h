// Finds the samples that small triangles cover, and the inputs of their depth planes, one 32-bit lane per
// triangle.
//
// A triangle is small if its vertices are less than 16 px apart on both axes and the drawn part of its box
// is at most 8 x 8 px. So steps and distances stay below 2^4 px: edge values below 2^25 on the coarse grid,
// and below 2^39 on the fine one, where the shifted ones of rule 5 fit 32 bits. G is the grid (core/grid.h).
#include <hwy/highway.h>

#include <bit>
#include <cstdint>

#include "raster/binning/mask_lists.h"
#include "raster/binning/packet_sorter.h"
#include "raster/simd/rule_lanes-inl.h"
#include "raster/simd/triangle_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_MASK_COVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_MASK_COVERAGE_INL_H
#undef EDGEWISE_MASK_COVERAGE_INL_H
#else
#define EDGEWISE_MASK_COVERAGE_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class G>
constexpr std::int32_t kMaxSmallExtent = 16 * G::kSub;  // a small triangle is less wide and high

// Whether edge values of small triangles fit 32 bits before they are shifted.
template <class G>
constexpr bool kFits32 = std::int64_t{2} * kMaxSmallExtent<G>* kMaxSmallExtent<G> < std::int64_t{1} << 31;

// Small triangles that cover a sample, in submission order. Whole vectors may be stored past the last.
struct Covering {
  static constexpr int kCapacity = kPacket + 16;
  int count = 0;
  alignas(64) std::int32_t index[kCapacity];              // of the triangle in its packet
  alignas(64) std::int32_t x0[kCapacity], y0[kCapacity];  // first pixel of the box
  alignas(64) std::int32_t covered[2][kCapacity];  // as in CoverageMask, but from the box's first pixel on
  alignas(64) std::int32_t payload[kCapacity];
  // depth_lanes-inl.h
  alignas(64) std::int32_t dx1[kCapacity], dx2[kCapacity], dy1[kCapacity], dy2[kCapacity], dz1[kCapacity],
      dz2[kCapacity];
  alignas(64) std::int32_t from_x[kCapacity], from_y[kCapacity], anchor_z[kCapacity];
};

template <class G>
HWY_INLINE hn::Mask<D> is_small(const GridTriangles<G>& t, const BoxLanes& box) {
  const D d;
  const V side = hn::Set(d, kMaskSide), longest = hn::Set(d, kMaxSmallExtent<G>);
  // Differences of coordinates fit 32 bits (rule 3).
  const auto fits = [&](V begin, V end, const V(&c)[3]) {
    return hn::AndNot(hn::Gt(hn::Sub(end, begin), side), hn::Lt(hn::Sub(max_of(c), min_of(c)), longest));
  };
  return hn::And(box.filled, hn::And(fits(box.x0, box.x1, t.x), fits(box.y0, box.y1, t.y)));
}

// The column at which an edge crosses a row, from the box's first sample, is stored plus 17 (2.5 as 19.5).
// That rounds down to 16 + the next column. In a float from 16 to 32, bits 19 and up count whole columns.
constexpr float kFirst = 16, kBefore = 17, kEnd = kFirst + kMaskSide + 1;
static_assert(kEnd < 2 * kFirst);

// The samples of a row that lie inside all edges so far.
class RowSpan {
 public:
  HWY_INLINE explicit RowSpan(V width) {
    const DF df;
    begin_ = hn::Set(df, kFirst + 0.5f);
    end_ = hn::Add(hn::ConvertTo(df, width), hn::Set(df, kFirst + 0.5f));
  }
  HWY_INLINE void begin_after(VF crossing, hn::Mask<DF> where) {
    begin_ = hn::IfThenElse(where, hn::Max(begin_, crossing), begin_);
  }
  HWY_INLINE void end_before(VF crossing, hn::Mask<DF> where) {
    end_ = hn::IfThenElse(where, hn::Min(end_, crossing), end_);
  }
  // Bit x is sample x.
  HWY_INLINE V bits() const {
    const D d;
    const DF df;
    const auto ones_from = [&](VF crossing) {
      const V column = hn::And(hn::ShiftRight<19>(hn::BitCast(d, crossing)), hn::Set(d, 15));
      return hn::Set(d, -1) << column;
    };
    return hn::AndNot(ones_from(hn::Max(end_, hn::Set(df, kFirst))),
                      ones_from(hn::Min(begin_, hn::Set(df, kEnd))));
  }

 private:
  VF begin_, end_;
};

// The crossings of an edge with one row of samples after another, in floats that decide as the integers of
// rule 5.
//
// At sample x of a row the edge value is the integer e + a x, |a| < 2^12. The sample is inside if that is >=
// 0, that is, if e + a x + 1/2 > 0. This sum is at least 1/2 away from 0, so the crossing, where it is 0, is
// more than 2^-13 columns away from every sample. All sums are exact: below 2^18, in halves or 32nds. The
// reciprocal and the product move a crossing below 32 by less than 2^-16 in any rounding mode, so never past
// a sample.
class Crossings {
 public:
  Crossings() = default;
  // `first`: at the box's first sample. `a`, `b`: steps to the next column and to the next row.
  HWY_INLINE Crossings(V a, V b, V first) {
    static_assert(kMaxSmallExtent<Coarse> <= 1 << 12);
    const DF df;
    const VF back = hn::ConvertTo(df, hn::Neg(a));
    rises_ = hn::Lt(back, hn::Zero(df));
    // With 1/32, a horizontal edge crosses at 33 or beyond if e >= 0, else at 1 or before.
    const VF nonzero = hn::IfThenElse(hn::Eq(back, hn::Zero(df)), hn::Set(df, 1.0f / 32), back);
    inverse_ = hn::Div(hn::Set(df, 1.0f), nonzero);
    step_y_ = hn::ConvertTo(df, b);
    value_ =
        hn::Add(hn::Add(hn::ConvertTo(df, first), hn::Set(df, 0.5f)), hn::Mul(nonzero, hn::Set(df, kBefore)));
  }
  // Restricts `span` to the samples of the next row that are inside this edge.
  HWY_INLINE void cut_row(RowSpan& span) {
    const VF crossing = hn::Mul(value_, inverse_);
    span.begin_after(crossing, rises_);
    span.end_before(crossing, hn::Not(rises_));
    value_ = hn::Add(value_, step_y_);
  }

 private:
  VF value_, step_y_, inverse_;
  hn::Mask<DF> rises_;
};

// 64-bit numbers of all lanes: those of the even lanes, and those of the odd ones.
struct WideLanes {
  V64 even, odd;
  HWY_INLINE WideLanes operator+(const WideLanes& b) const {
    return {hn::Add(even, b.even), hn::Add(odd, b.odd)};
  }
  HWY_INLINE WideLanes operator-(const WideLanes& b) const {
    return {hn::Sub(even, b.even), hn::Sub(odd, b.odd)};
  }
  // One less where `mask` is -1.
  HWY_INLINE WideLanes less_one_where(V mask) const {
    return {hn::Sub(even, hn::And(as64(mask), hn::Set(D64{}, 1))), hn::Sub(odd, shift_right<63>(as64(mask)))};
  }
  // The lower 32 bits of the numbers shifted right.
  template <int kBits>
  HWY_INLINE V shifted() const {
    return hn::OddEven(lower(hn::ShiftLeft<32 - kBits>(odd)), lower(shift_right<kBits>(even)));
  }
};
HWY_INLINE WideLanes wide_product(V a, V b) {
  return {product(a, b), product(upper(as64(a)), upper(as64(b)))};
}

// The sides of small triangles from vertex 0 on, turned where the area is negative (rule 4).
struct SmallSides {
  V dx1, dx2, dy1, dy2;
  template <class G>
  HWY_INLINE explicit SmallSides(const GridTriangles<G>& t) {
    const auto minus = [](V a, V b) { return hn::Sub(a, b); };
    const V x1 = minus(t.x[1], t.x[0]), x2 = minus(t.x[2], t.x[0]);
    const V y1 = minus(t.y[1], t.y[0]), y2 = minus(t.y[2], t.y[0]);
    const auto sign = [&] {
      if constexpr (kFits32<G>) return minus(hn::Mul(x1, y2), hn::Mul(y1, x2));
      return (wide_product(x1, y2) - wide_product(y1, x2)).template shifted<32>();
    };
    const V flip = hn::BroadcastSignBit(sign());
    dx1 = flipped(x1, flip), dx2 = flipped(x2, flip);
    dy1 = flipped(y1, flip), dy2 = flipped(y2, flip);
  }
};

// The first `count` of four rows of 8 bits, 0 … 4, in two shifts: no shift by 32 bits.
HWY_INLINE V first_rows(V count) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const V left_out = hn::ShiftLeft<3>(hn::Sub(hn::Set(d, 4), count));
  const auto half = hn::BitCast(du, hn::ShiftRight<1>(left_out));
  return hn::BitCast(d, (hn::Set(du, 0xFFFFFFFF) >> half) >> half);
}

// The values of small triangles' edges at their boxes' first samples, shifted (rule 5), and their steps.
struct SmallEdges {
  V a[3], b[3], first[3];
  template <class G>
  HWY_INLINE SmallEdges(const GridTriangles<G>& t, const SmallSides& sides, const BoxLanes& box)
      : a{hn::Neg(sides.dy1), hn::Sub(sides.dy1, sides.dy2), sides.dy2},
        b{sides.dx1, hn::Sub(sides.dx2, sides.dx1), hn::Neg(sides.dx2)} {
    const V sx = sample<G>(box.x0), sy = sample<G>(box.y0);
    for (int i = 0; i < 3; ++i) {
      const V bias = hn::IfThenZeroElse(is_top_left(a[i], b[i]), hn::Set(D{}, -1));
      const V from_x = hn::Sub(sx, t.x[i]), from_y = hn::Sub(sy, t.y[i]);
      if constexpr (kFits32<G>)
        first[i] =
            hn::ShiftRight<G::kSubBits>(hn::Add(hn::Add(hn::Mul(a[i], from_x), hn::Mul(b[i], from_y)), bias));
      else
        first[i] = (wide_product(a[i], from_x) + wide_product(b[i], from_y))
                       .less_one_where(bias)
                       .template shifted<G::kSubBits>();
    }
  }
};

// The samples that small triangles cover: the upper and the lower four rows of their boxes.
template <class G>
HWY_INLINE void find_covered(const GridTriangles<G>& t, const SmallSides& sides, const BoxLanes& box,
                             hn::Mask<D> small, V (&covered)[2]) {
  const D d;
  SmallEdges edges(t, sides, box);
  const V width = hn::Sub(box.x1, box.x0), height = hn::Sub(box.y1, box.y0);
  const auto most = [&](V size) { return hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(small, size))); };
  const int rows = most(height);
  covered[0] = covered[1] = hn::Zero(d);
  if constexpr (kFits32<G>) {
    Crossings crossings[3];
    for (int i = 0; i < 3; ++i) crossings[i] = Crossings(edges.a[i], edges.b[i], edges.first[i]);
    const RowSpan whole(width);
    for (int y = 0; y < rows; ++y) {
      RowSpan span = whole;
      for (Crossings& e : crossings) e.cut_row(span);
      V& half = covered[y / 4];
      half = hn::Or(half, hn::ShiftLeftSame(span.bits(), y % 4 * 8));
    }
  } else {
    // Floats are not exact here, so each sample is tested.
    const int columns = most(width);
    for (int y = 0; y < rows; ++y) {
      V value[3] = {edges.first[0], edges.first[1], edges.first[2]};
      V bit = hn::Set(d, 1 << y % 4 * 8), row = hn::Zero(d);
      for (int x = 0; x < columns; ++x) {
        const V outside = hn::BroadcastSignBit(hn::Or(hn::Or(value[0], value[1]), value[2]));
        row = hn::Or(row, hn::AndNot(outside, bit));
        for (int i = 0; i < 3; ++i) value[i] = hn::Add(value[i], edges.a[i]);
        bit = hn::Add(bit, bit);
      }
      covered[y / 4] = hn::Or(covered[y / 4], row);
      for (int i = 0; i < 3; ++i) edges.first[i] = hn::Add(edges.first[i], edges.b[i]);
    }
    const V in_row = hn::Sub(hn::Set(d, 1) << hn::Min(width, hn::Set(d, 8)), hn::Set(d, 1));
    const V in_rows = hn::Mul(in_row, hn::Set(d, 0x01010101));
    covered[0] = hn::And(covered[0], in_rows), covered[1] = hn::And(covered[1], in_rows);
  }
  const V upper_rows = hn::Min(height, hn::Set(d, 4));
  covered[0] = hn::And(covered[0], first_rows(upper_rows));
  covered[1] = hn::And(covered[1], first_rows(hn::Sub(height, upper_rows)));
}

// Appends the triangles of a vector that are small and cover a sample. Bit i of the result is set if triangle
// i does. `index`: of the first, in the packet.
template <class G>
HWY_INLINE std::uint32_t append_covering(const GridTriangles<G>& t, const BoxLanes& box, hn::Mask<D> small,
                                         int index, Covering& out) {
  const SmallSides sides(t);
  V covered[2];
  find_covered(t, sides, box, small, covered);
  // A triangle without area covers no sample: its three values add up to 0, and not all edges are top or
  // left.
  const auto covers = hn::And(small, hn::Ne(hn::Or(covered[0], covered[1]), hn::Zero(D{})));
  const AnchorLanes anchor(t.x, t.y, t.z);
  const auto from_anchor = [](V px, V anchor_sub) {
    return hn::Sub(sample<G>(hn::And(px, hn::Set(D{}, -kDepthCell))), anchor_sub);
  };
  const Selection select(covers);
  const auto keep = [&](V v, std::int32_t* list) { hn::StoreU(select(v), D{}, list + out.count); };
  keep(counting_from(index), out.index);
  keep(box.x0, out.x0), keep(box.y0, out.y0);
  keep(covered[0], out.covered[0]), keep(covered[1], out.covered[1]);
  keep(t.payload, out.payload);
  keep(sides.dx1, out.dx1), keep(sides.dx2, out.dx2), keep(sides.dy1, out.dy1), keep(sides.dy2, out.dy2);
  keep(hn::Sub(t.z[1], t.z[0]), out.dz1), keep(hn::Sub(t.z[2], t.z[0]), out.dz2);
  keep(from_anchor(box.x0, anchor.x), out.from_x), keep(from_anchor(box.y0, anchor.y), out.from_y);
  keep(anchor.z, out.anchor_z);
  const std::uint32_t covering = mask_bits(covers);
  out.count += std::popcount(covering);
  return covering;
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

#endif

// Edge functions in lanes: the overloads of fill() and fill_by_steps() for plots in lanes. Samples of a box
// are tested a vector of a row at a time; in wide boxes the interval search of fill_between() skips the
// pixels outside.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "lab/coverage/fixed_edges.h"
#include "lab/coverage/float_edges.h"
#include "lab/coverage/lane_plot-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_LAB_EDGES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_LAB_EDGES_INL_H
#undef EDGEWISE_LAB_EDGES_INL_H
#else
#define EDGEWISE_LAB_EDGES_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace edgewise::lab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Testing every pixel is faster for boxes up to this width.
constexpr int kNarrowForLanes_px = 8 * kLanes;

// RealEdge::Row::accepts() for a vector of columns and kLanes rows. Doubles fill two vectors.
template <typename Real>
class RealLanes {
 public:
  explicit RealLanes(const RealEdge<Real> (&edges)[3]) : edges_(edges) {}

  HWY_INLINE void rows_from(int y) {
    for (int i = 0; i < 3; ++i)
      for (int half = 0; half < kHalves; ++half)
        hn::Store(hn::Mul(hn::Set(D{}, edges_[i].b), hn::Sub(samples(y, half), hn::Set(D{}, edges_[i].y))),
                  D{}, down_[i] + half * kPerHalf);
  }
  HWY_INLINE void columns_from(int x) {
    for (int i = 0; i < 3; ++i)
      for (int half = 0; half < kHalves; ++half)
        across_[i][half] =
            hn::Mul(hn::Set(D{}, edges_[i].a), hn::Sub(samples(x, half), hn::Set(D{}, edges_[i].x)));
  }
  HWY_INLINE LaneMask accepted(int row) const {
    const auto half_of = [&](int half) HWY_ATTR {
      const auto by = [&](int i) HWY_ATTR {
        return hn::Gt(hn::Add(across_[i][half], hn::Set(D{}, down_[i][row])),
                      hn::Set(D{}, edges_[i].threshold));
      };
      return hn::And(hn::And(by(0), by(1)), by(2));
    };
    if constexpr (kHalves == 1) {
      return half_of(0);
    } else {
      const auto lanes_of = [&](int half)
                                HWY_ATTR { return hn::BitCast(DI{}, hn::VecFromMask(D{}, half_of(half))); };
      return hn::RebindMask(DF{}, hn::MaskFromVec(hn::ConcatEven(DI{}, lanes_of(1), lanes_of(0))));
    }
  }

 private:
  static constexpr int kHalves = sizeof(Real) / sizeof(float), kPerHalf = kLanes / kHalves;
  using D = hn::CappedTag<Real, std::size_t{kPerHalf}>;
  using V = hn::Vec<D>;

  // The coordinates of the samples of a half.
  static HWY_INLINE V samples(int first, int half) {
    const V numbers = hn::Add(hn::Iota(D{}, 0), hn::Set(D{}, static_cast<Real>(first + half * kPerHalf)));
    return hn::Add(numbers, hn::Set(D{}, Real{0.5f}));
  }

  const RealEdge<Real> (&edges_)[3];
  V across_[3][std::size_t{kHalves}];
  HWY_ALIGN Real down_[3][kLanes];
};

// FixedEdge in 32 bits, which step from row to row.
class IntLanes {
 public:
  // Values are divided by 2^shift, rounded down. Their signs stay, since the steps are multiples of 2^shift.
  template <typename Int>
  IntLanes(const FixedEdge<Int> (&edges)[3], const PixelBounds& box, int shift) : box_(box) {
    for (int i = 0; i < 3; ++i) {
      const auto short_of = [&](auto v) { return static_cast<std::uint32_t>(static_cast<Int>(v) >> shift); };
      first_[i] = short_of(edges[i].value);
      step_x_[i] = short_of(edges[i].step_x);
      step_y_[i] = short_of(edges[i].step_y);
    }
  }

  HWY_INLINE void rows_from(int y) {
    const auto down = static_cast<std::uint32_t>(y - box_.y0);
    for (int i = 0; i < 3; ++i) row_[i] = first_[i] + step_y_[i] * down;
  }
  HWY_INLINE void columns_from(int x) {
    const VI columns = counting_from(x - box_.x0);
    for (int i = 0; i < 3; ++i) value_[i] = hn::Add(all(row_[i]), hn::Mul(all(step_x_[i]), columns));
  }
  HWY_INLINE LaneMask accepted(int) {
    const VI outside = hn::Or(hn::Or(value_[0], value_[1]), value_[2]);  // negative if one of them is
    for (int i = 0; i < 3; ++i) value_[i] = hn::Add(value_[i], all(step_y_[i]));
    return hn::RebindMask(DF{}, hn::Gt(outside, hn::Set(DI{}, -1)));
  }

 private:
  static HWY_INLINE VI all(std::uint32_t v) { return hn::Set(DI{}, static_cast<std::int32_t>(v)); }

  PixelBounds box_;
  std::uint32_t first_[3], step_x_[3], step_y_[3], row_[3] = {};  // two's complement
  VI value_[3];
};

template <class Edges>
HWY_INLINE void test_in_lanes(Edges edges, const PixelBounds& box, const LanePlot& plot) {
  HWY_ALIGN float depths[kLanes];
  for (int y = box.y0; y < box.y1; y += kLanes) {
    const int rows = std::min(kLanes, box.y1 - y);
    plot.row_depths(y, depths);
    edges.rows_from(y);
    for (int x = vector_at(box.x0); x < box.x1; x += kLanes) {
      edges.columns_from(x);
      const VF column_depths = plot.column_depths(x);
      const LaneMask in_box = lanes_between(x, box.x0, box.x1);
      for (int row = 0; row < rows; ++row)
        plot.draw(y + row, x, depths[row], column_depths, hn::And(in_box, edges.accepted(row)));
    }
  }
}

template <typename Real>
inline void fill(const RealEdge<Real> (&edges)[3], const PixelBounds& box, LanePlot& plot) {
  if (box.x1 - box.x0 <= kNarrowForLanes_px)
    test_in_lanes(RealLanes<Real>(edges), box, plot);
  else
    fill_between(edges, box, plot);
}

template <typename Int>
inline void fill(const FixedEdge<Int> (&edges)[3], const FixedBox& box, LanePlot& plot) {
  // Values that wrap in 32 bits are stepped as they are; others are divided by the step of a sample.
  const int shift = sizeof(Int) == sizeof(std::int32_t) ? 0 : box.bits;
  const bool in_32_bits = shift == 0 || box.area < static_cast<double>(std::int64_t{1} << (31 + shift));
  const bool narrow = box.pixels.x1 - box.pixels.x0 <= kNarrowForLanes_px, holds = box.holds<Int>();
  if (in_32_bits && (narrow || !holds))
    test_in_lanes(IntLanes(edges, box.pixels, shift), box.pixels, plot);
  else if (holds)
    fill_between(edges, box.pixels, plot);
  else
    test_every_pixel(edges, box.pixels, plot);
}

// The errors of a row accumulate from column to column, so lanes are rows.
inline void fill_by_steps(const RealEdge<float> (&edges)[3], const PixelBounds& box, LanePlot& plot) {
  const float sx = static_cast<float>(box.x0) + 0.5f, sy = static_cast<float>(box.y0) + 0.5f;
  float row[3];
  for (int i = 0; i < 3; ++i) row[i] = edges[i].at(sx, sy);
  HWY_ALIGN float starts[3][kLanes];
  HWY_ALIGN std::int32_t before[kLanes], inside[kLanes];
  for (int y = box.y0; y < box.y1; y += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane)
      for (int i = 0; i < 3; ++i) {
        starts[i][lane] = row[i];
        row[i] += edges[i].b;
      }
    VF v0 = hn::Load(DF{}, starts[0]), v1 = hn::Load(DF{}, starts[1]), v2 = hn::Load(DF{}, starts[2]);
    VI skipped = hn::Zero(DI{}), accepted = hn::Zero(DI{});
    for (int x = box.x0; x < box.x1; ++x) {
      const auto by = [&](VF v, int i) HWY_ATTR { return hn::Gt(v, hn::Set(DF{}, edges[i].threshold)); };
      const auto all = hn::RebindMask(DI{}, hn::And(hn::And(by(v0, 0), by(v1, 1)), by(v2, 2)));
      accepted = hn::Sub(accepted, hn::VecFromMask(DI{}, all));
      skipped = hn::Sub(skipped, hn::VecFromMask(DI{}, hn::Eq(accepted, hn::Zero(DI{}))));
      v0 = hn::Add(v0, hn::Set(DF{}, edges[0].a));
      v1 = hn::Add(v1, hn::Set(DF{}, edges[1].a));
      v2 = hn::Add(v2, hn::Set(DF{}, edges[2].a));
    }
    hn::Store(skipped, DI{}, before);
    hn::Store(accepted, DI{}, inside);
    for (int lane = 0; lane < std::min(kLanes, box.y1 - y); ++lane) {
      const int begin = box.x0 + before[lane];
      plot.span(y + lane, begin, begin + inside[lane]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise::lab
HWY_AFTER_NAMESPACE();
#endif

#endif

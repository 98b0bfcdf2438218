// DepthPlot in lanes: the same depths and the same test, for the pixels of one aligned vector of a row.
#include <hwy/highway.h>

#include <cstdint>

#include "lab/coverage/plot.h"

// Included once per SIMD target.
#if defined(EDGEWISE_LANE_PLOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_LANE_PLOT_INL_H
#undef EDGEWISE_LANE_PLOT_INL_H
#else
#define EDGEWISE_LANE_PLOT_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise::lab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
using LanePlot = DepthPlot;
#else

using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using LaneMask = hn::Mask<DF>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(DF{}));

// The first pixel of the vector with column x. Vectors lie inside a row's memory, as its stride is a multiple
// of every kLanes.
HWY_INLINE int vector_at(int x) {
  return x & -kLanes;
}
HWY_INLINE VI counting_from(int first) {
  return hn::Add(hn::Iota(DI{}, 0), hn::Set(DI{}, first));
}
// The lanes of the vector at x that lie in columns x0 … x1 - 1.
HWY_INLINE LaneMask lanes_between(int x, int x0, int x1) {
  const VI column = counting_from(x);
  return hn::RebindMask(DF{},
                        hn::And(hn::Gt(column, hn::Set(DI{}, x0 - 1)), hn::Lt(column, hn::Set(DI{}, x1))));
}

class LanePlot : public DepthPlot {
 public:
  using DepthPlot::DepthPlot;

  // A pixel's depth is the sum of a part of its row and a part of its column, rounded as in DepthPlot.
  HWY_INLINE float row_depth(int y) const { return z_ + zy_ * static_cast<float>(y); }
  HWY_INLINE void row_depths(int y, float* depths) const {
    const VF rows = hn::ConvertTo(DF{}, counting_from(y));
    hn::Store(hn::Add(hn::Set(DF{}, z_), hn::Mul(hn::Set(DF{}, zy_), rows)), DF{}, depths);
  }
  HWY_INLINE VF column_depths(int x) const {
    return hn::Mul(hn::Set(DF{}, zx_), hn::ConvertTo(DF{}, counting_from(x)));
  }

  // Draws the pixels of `lanes` in row y, of the vector at x.
  HWY_INLINE void draw(int y, int x, float row_depth, VF column_depths, LaneMask lanes) const {
    const std::ptrdiff_t at = y * stride_ + x;
    const VF z = hn::Add(hn::Set(DF{}, row_depth), column_depths), old_z = hn::Load(DF{}, depth_ + at);
    const LaneMask nearer = hn::And(lanes, hn::Lt(z, old_z));
    hn::Store(hn::IfThenElse(nearer, z, old_z), DF{}, depth_ + at);
    const auto colours = hn::Set(DU{}, triangle_.payload);
    const auto shown = hn::RebindMask(DU{}, nearer);
#if HWY_TARGET == HWY_AVX3
    hn::BlendedStore(colours, shown, DU{}, payload_ + at);
#else  // masked stores are slow or emulated
    hn::Store(hn::IfThenElse(shown, colours, hn::Load(DU{}, payload_ + at)), DU{}, payload_ + at);
#endif
  }
  void span(int y, int x0, int x1) const {
    const float depth = row_depth(y);
    for (int x = vector_at(x0); x < x1; x += kLanes)
      draw(y, x, depth, column_depths(x), lanes_between(x, x0, x1));
  }
};
#endif

}  // namespace HWY_NAMESPACE
}  // namespace edgewise::lab
HWY_AFTER_NAMESPACE();

#endif

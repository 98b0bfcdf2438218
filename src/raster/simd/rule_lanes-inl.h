// Rules of the contract in vectors, one triangle per lane of 32 bits or 64. G is the grid (core/grid.h).
#include <hwy/highway.h>

#include <cstdint>

#include "core/grid.h"
#include "core/lanes-inl.h"
#include "edgewise/contract.h"

// Included once per SIMD target.
#if defined(EDGEWISE_RULE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_RULE_LANES_INL_H
#undef EDGEWISE_RULE_LANES_INL_H
#else
#define EDGEWISE_RULE_LANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace contract;

// Whether all positions of stored triangles lie on the grid.
template <class G>
HWY_INLINE bool are_on(const TriangleLanes& t) {
  V any = hn::Or(t.x[0], t.y[0]);
  for (int i = 1; i < 3; ++i) any = hn::Or(any, hn::Or(t.x[i], t.y[i]));
  const V spare = hn::And(any, hn::Set(D{}, (1 << G::kSpareBits) - 1));
  return hn::AllTrue(D{}, hn::Eq(spare, hn::Zero(D{})));
}

// Triangles whose positions are in sub-units of the grid.
template <class G>
struct GridTriangles : TriangleLanes {
  HWY_INLINE explicit GridTriangles(const TriangleLanes& t) : TriangleLanes(t) {
    if constexpr (G::kSpareBits > 0)
      for (int i = 0; i < 3; ++i)
        x[i] = hn::ShiftRight<G::kSpareBits>(x[i]), y[i] = hn::ShiftRight<G::kSpareBits>(y[i]);
  }
};

HWY_INLINE V min_of(const V (&v)[3]) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE V max_of(const V (&v)[3]) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}
// -v where `flip` is -1, v where it is 0.
HWY_INLINE V flipped(V v, V flip) {
  return hn::Sub(hn::Xor(v, flip), flip);
}
// Sample positions, in sub-units, of pixels that are numbered from pixel `first` on.
template <class G>
HWY_INLINE V sample(V px, int first = 0) {
  return hn::Add(hn::ShiftLeft<G::kSubBits>(px), hn::Set(D{}, G::sample(first)));
}

// The part of pixel_box() that lies in another box.
struct BoxLanes {
  V x0, y0, x1, y1;
  hn::Mask<D> filled;

  template <class G>
  HWY_INLINE BoxLanes(const GridTriangles<G>& t, const PixelBox& in) {
    const D d;
    const auto first_sample = [&](V c) {
      return hn::ShiftRight<G::kSubBits>(hn::Add(c, hn::Set(d, G::kHalf - 1)));
    };
    x0 = hn::Max(first_sample(min_of(t.x)), hn::Set(d, in.x0));
    x1 = hn::Min(first_sample(max_of(t.x)), hn::Set(d, in.x1));
    y0 = hn::Max(first_sample(min_of(t.y)), hn::Set(d, in.y0));
    y1 = hn::Min(first_sample(max_of(t.y)), hn::Set(d, in.y1));
    filled = hn::And(hn::Lt(x0, x1), hn::Lt(y0, y1));
  }
};

// Rule 4, for integers or floats.
template <class Vector>
HWY_INLINE auto is_top_left(Vector a, Vector b) {
  const auto zero = hn::Zero(hn::DFromV<Vector>{});
  return hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
}

// Rule 6: the topmost, then leftmost vertex.
struct AnchorLanes {
  V x, y, z;

  HWY_INLINE AnchorLanes(const V (&vx)[3], const V (&vy)[3], const V (&vz)[3])
      : x(vx[0]), y(vy[0]), z(vz[0]) {
    for (int i = 1; i < 3; ++i) {
      const auto above = hn::Or(hn::Lt(vy[i], y), hn::And(hn::Eq(vy[i], y), hn::Lt(vx[i], x)));
      x = hn::IfThenElse(above, vx[i], x);
      y = hn::IfThenElse(above, vy[i], y);
      z = hn::IfThenElse(above, vz[i], z);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

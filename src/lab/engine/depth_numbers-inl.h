// Other depths with the contract's edge functions: fewer bits, and planes in floats.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "edgewise/contract.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/wide_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_DEPTH_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_DEPTH_NUMBERS_INL_H
#undef EDGEWISE_DEPTH_NUMBERS_INL_H
#else
#define EDGEWISE_DEPTH_NUMBERS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class DepthPolicy>
struct DepthNumbers : ContractNumbers {
  using Depth = DepthPolicy;
};

// The contract's planes in a depth buffer of kBits bits.
template <int kBits>
struct DepthOfBits : ContractDepth {
  static constexpr int kDropped = 31 - kBits;
  static HWY_INLINE V stored(V z) { return hn::ShiftRight<kDropped>(z); }
  static std::int32_t stored(std::int32_t z) { return z >> kDropped; }
};

// A plane in floats through vertices with depths from 0 to 1, as in GradientPlane<float>
// (lab/visibility/depth_buffer.h). The bits of floats >= 0 are ordered as their values are.
struct FloatDepth : FloatLanes {
  static HWY_INLINE V stored(Vector z) { return hn::BitCast(D{}, hn::Max(z, hn::Zero(Floats{}))); }
  static std::int32_t stored(float z) {
    const hn::CappedTag<float, 1> one;
    return hn::GetLane(
        hn::BitCast(hn::CappedTag<std::int32_t, 1>{}, hn::Max(hn::Set(one, z), hn::Zero(one))));
  }

  // A vector of triangles. From vertex 0 to vertices 1 and 2, to the first sample of the box's blocks, and
  // the area that belongs to the same signs; all in px.
  template <class DF>
  struct Triangles {
    hn::Vec<DF> dx[2], dy[2], z[3];
    hn::Vec<DF> area, from_x, from_y;
    hn::Vec<DF> across, down;  // px, from the first block to the last
  };
  // Stores the plane and the nearest depth from index k on.
  template <class DF, class Batch>
  static HWY_INLINE void store_plane(DF df, const Triangles<DF>& t, Batch& out, int k) {
    using F = hn::Vec<DF>;
    const F zero = hn::Zero(df), three = hn::Set(df, kBlockSide - 1.0f);
    const F dz1 = hn::Sub(t.z[1], t.z[0]), dz2 = hn::Sub(t.z[2], t.z[0]);
    const F x = hn::Div(hn::Sub(hn::Mul(dz1, t.dy[1]), hn::Mul(dz2, t.dy[0])), t.area);
    const F y = hn::Div(hn::Sub(hn::Mul(dz2, t.dx[0]), hn::Mul(dz1, t.dx[1])), t.area);
    const F first = hn::Add(t.z[0], hn::Add(hn::Mul(x, t.from_x), hn::Mul(y, t.from_y)));
    store_functions(df, x, y, first, out.depth, k);

    // HiZ must not reject what rounding makes nearer. In a flat plane all terms are small; in a steep one the
    // bound is 0.
    const F margin = hn::Set(df, 0x1p-18f), steep = hn::Set(df, 0x1p-7f);
    hn::StoreU(hn::Add(hn::LoadU(df, out.depth.most + k), margin), df, out.depth.most + k);
    const auto flat = hn::And(hn::Lt(hn::Abs(x), steep), hn::Lt(hn::Abs(y), steep));
    const F low_x = hn::Min(x, zero), low_y = hn::Min(y, zero);
    const F near_x = hn::IfThenElseZero(flat, x), near_y = hn::IfThenElseZero(flat, y);
    const F near_first =
        hn::IfThenElseZero(flat, hn::Sub(hn::Add(first, hn::Mul(three, hn::Add(low_x, low_y))), margin));
    hn::StoreU(near_x, df, out.nearest.x + k), hn::StoreU(near_y, df, out.nearest.y + k);
    hn::StoreU(near_first, df, out.nearest.first + k);
    const F falls = hn::Add(hn::Mul(low_x, t.across), hn::Mul(low_y, t.down));
    hn::StoreU(hn::Add(near_first, hn::IfThenElseZero(flat, falls)), df, out.nearest.least + k);
  }

  template <class DF>
  static HWY_INLINE hn::Vec<DF> in_px(DF df, hn::Vec<DF> sub) {
    return hn::Mul(sub, hn::Set(df, 1.0f / contract::kSub));
  }
  template <class DF>
  static HWY_INLINE hn::Vec<DF> depth01(DF df, hn::Vec<DF> z) {
    return hn::Mul(z, hn::Set(df, static_cast<float>(1.0 / contract::kDepthRange)));
  }
  // From the area in sub-units, which is exact in a double.
  template <class DD>
  static HWY_INLINE hn::Vec<hn::Rebind<float, DD>> area_px(DD dd, hn::Vec<DD> area) {
    const auto squares = hn::Set(dd, 1.0 / (contract::kSub * contract::kSub));
    return hn::DemoteTo(hn::Rebind<float, DD>{}, hn::Mul(area, squares));
  }

  template <class Batch>
  static void set_up_one(const TileTask& task, const contract::Oriented& t, int left, int top, int across,
                         int down, Batch& out, int k) {
    using One = hn::CappedTag<float, 1>;
    const One one;
    const auto set = [&](std::int64_t v) { return hn::Set(one, static_cast<float>(v)); };
    const auto px = [&](std::int64_t sub) { return in_px(one, set(sub)); };
    const auto z01 = [&](int i) { return depth01(one, set(t.z[i] - contract::kDepthHead)); };
    const hn::CappedTag<double, 1> wide;
    store_plane(one,
                Triangles<One>{{px(t.x[1] - t.x[0]), px(t.x[2] - t.x[0])},
                               {px(t.y[1] - t.y[0]), px(t.y[2] - t.y[0])},
                               {z01(0), z01(1), z01(2)},
                               area_px(wide, hn::Set(wide, static_cast<double>(t.area))),
                               px(contract::sample_sub(task.x0 + left) - t.x[0]),
                               px(contract::sample_sub(task.y0 + top) - t.y[0]),
                               set(kBlockSide * across),
                               set(kBlockSide * down)},
                out, k);
  }

#if HWY_TARGET != HWY_SCALAR
  // Half a vector of triangles, in sub-units.
  struct Half {
    V32 dx[2], dy[2], z[3], from_x, from_y;
    hn::Vec<hn::Rebind<float, F64>> area_px;
  };
  static HWY_INLINE std::uint32_t set_up_half(const TileTask& task, const TriangleLanes& t, const Area& area,
                                              V32 left, V32 top, Half& out) {
    const V32 flip = lower(area.flip);
    for (int i = 0; i < 2; ++i) {
      out.dx[i] = flipped(hn::Sub(t.x[i + 1], t.x[0]), flip);
      out.dy[i] = flipped(hn::Sub(t.y[i + 1], t.y[0]), flip);
    }
    for (int i = 0; i < 3; ++i) out.z[i] = hn::Sub(t.z[i], set32(contract::kDepthHead));
    const auto sample = [](V32 px, int origin) {
      return hn::Add(hn::ShiftLeft<contract::kSubBits>(px), set32(contract::sample_sub(origin)));
    };
    out.from_x = hn::Sub(sample(left, task.x0), t.x[0]);
    out.from_y = hn::Sub(sample(top, task.y0), t.y[0]);
    out.area_px = area_px(F64{}, hn::ConvertTo(F64{}, area.value));
    return ~0u;
  }
  template <class Batch>
  static HWY_INLINE void store_planes(const Half& left, const Half& right, V across, V down, Batch& out,
                                      int k) {
    const Floats df;
    const auto whole = [&](V32 l, V32 r) { return hn::ConvertTo(df, both(l, r)); };
    const auto px = [&](V32 l, V32 r) { return in_px(df, whole(l, r)); };
    Triangles<Floats> t;
    for (int i = 0; i < 2; ++i) t.dx[i] = px(left.dx[i], right.dx[i]), t.dy[i] = px(left.dy[i], right.dy[i]);
    for (int i = 0; i < 3; ++i) t.z[i] = depth01(df, whole(left.z[i], right.z[i]));
    t.area = hn::Combine(df, right.area_px, left.area_px);
    t.from_x = px(left.from_x, right.from_x), t.from_y = px(left.from_y, right.from_y);
    t.across = hn::ConvertTo(df, hn::ShiftLeft<2>(across));
    t.down = hn::ConvertTo(df, hn::ShiftLeft<2>(down));
    store_plane(df, t, out, k);
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

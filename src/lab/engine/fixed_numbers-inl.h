// Edge functions in fixed point without a shift: in int32, which wraps where a triangle is large, and in
// int64.
#include <hwy/highway.h>

#include <cstdint>

#include "edgewise/contract.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/wide_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_FIXED_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_FIXED_NUMBERS_INL_H
#undef EDGEWISE_FIXED_NUMBERS_INL_H
#else
#define EDGEWISE_FIXED_NUMBERS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All of the edges' arithmetic wraps at 32 bits: area, products, steps. Positions have kBits fraction bits;
// fewer than the snapped ones have are rounded from those.
template <int kBits>
struct WrappingNumbers : Int32Lanes {
  using Task = lab::EngineTask;
  using Depth = ContractDepth;
  using Edge = Linear<std::int32_t>;
  using Rule = ContractNumbers::Rule;
  static constexpr int kDropped = contract::kSubBits - kBits;
  static constexpr std::int32_t kMargin = (1 << kDropped) / 2;  // a vertex moves by at most this

  static Rule rule(const Edge (&)[3], int) { return {}; }
  static HWY_INLINE V outside(V e0, V e1, V e2, const Rule&) { return any_sign(e0, e1, e2); }
  static HWY_INLINE V negative(V e0, V e1, V e2) { return any_sign(e0, e1, e2); }
  static HWY_INLINE bool spans_more(Value span, std::int32_t twice_area_px) {
    return span >> 2 * kBits > twice_area_px;
  }

  template <class DI>
  struct Triangles {
    hn::Vec<DI> x[3], y[3];                 // sub-units
    hn::Vec<DI> left, top, last_x, last_y;  // BlockBox
  };
  // Stores the edges from out.x[k] on. The mask is set where an edge rejects the box.
  template <class DI>
  static HWY_INLINE hn::Mask<DI> set_up_edges(DI di, const Task& task, const Triangles<DI>& t, Edge (&out)[3],
                                              int k) {
    using I = hn::Vec<DI>;
    const I zero = hn::Zero(di);
    const auto rounded = [&](I v) {
      if constexpr (kDropped == 0)
        return v;
      else
        return hn::ShiftRight<kDropped>(hn::Add(v, hn::Set(di, kMargin)));
    };
    const auto sample = [&](I px, int origin) {
      return hn::Add(hn::ShiftLeft<kBits>(hn::Add(px, hn::Set(di, origin))), hn::Set(di, (1 << kBits) / 2));
    };
    const I sample_x = sample(t.left, task.x0), sample_y = sample(t.top, task.y0);
    I x[3], y[3];
    for (int i = 0; i < 3; ++i) x[i] = rounded(t.x[i]), y[i] = rounded(t.y[i]);
    const I area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                           hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
    const I flip = hn::VecFromMask(di, hn::Lt(area, zero));
    const auto turned = [&](I v) { return hn::Sub(hn::Xor(v, flip), flip); };
    auto rejected = hn::Eq(area, zero);
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const I a = turned(hn::Sub(y[i], y[j])), b = turned(hn::Sub(x[j], x[i]));
      const auto top_left = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
      const I bias = hn::IfThenZeroElse(top_left, hn::Set(di, 1));
      const I first =
          hn::Sub(hn::Add(hn::Mul(a, hn::Sub(sample_x, x[i])), hn::Mul(b, hn::Sub(sample_y, y[i]))), bias);
      const auto across = [&](I step_x, I step_y) {
        return hn::ShiftLeft<kBits>(hn::Add(hn::Mul(step_x, t.last_x), hn::Mul(step_y, t.last_y)));
      };
      const I most = hn::Add(first, across(hn::Max(a, zero), hn::Max(b, zero)));
      const I least = hn::Add(first, across(hn::Min(a, zero), hn::Min(b, zero)));
      rejected = hn::Or(rejected, hn::Lt(most, zero));
      const auto unless_accepted = [&](I v) { return hn::IfThenElseZero(hn::Lt(least, zero), v); };
      store_functions(di, unless_accepted(hn::ShiftLeft<kBits>(a)), unless_accepted(hn::ShiftLeft<kBits>(b)),
                      unless_accepted(first), out[i], k);
    }
    return rejected;
  }
  static bool set_up_one(const Task& task, std::uint32_t index, const contract::Oriented&,
                         const BlockBox& box, Edge (&out)[3], int k) {
    const hn::CappedTag<std::int32_t, 1> di;
    const auto set = [&](std::int32_t v) { return hn::Set(di, v); };
    const ScreenTriangle& t = task.triangles[index];
    const Triangles<hn::CappedTag<std::int32_t, 1>> one{{set(t.x_sub[0]), set(t.x_sub[1]), set(t.x_sub[2])},
                                                        {set(t.y_sub[0]), set(t.y_sub[1]), set(t.y_sub[2])},
                                                        set(box.left),
                                                        set(box.top),
                                                        set(box.last_x),
                                                        set(box.last_y)};
    return hn::AllFalse(di, set_up_edges(di, task, one, out, k));
  }

#if HWY_TARGET != HWY_SCALAR
  using HalfEdges = HalfPositions;
  static HWY_INLINE V64 set_up_half(const Task&, const std::uint32_t*, const TriangleLanes& t, const Area&,
                                    const BlockBoxLanes& box, HalfEdges& out) {
    for (int i = 0; i < 3; ++i) out.x[i] = t.x[i], out.y[i] = t.y[i];
    out.box = box;
    return hn::Zero(D64{});
  }
  static HWY_INLINE std::uint32_t store_edges(const Task& task, const HalfEdges& left, const HalfEdges& right,
                                              Edge (&out)[3], int k) {
    Triangles<D> t;
    for (int i = 0; i < 3; ++i) t.x[i] = both(left.x[i], right.x[i]), t.y[i] = both(left.y[i], right.y[i]);
    t.left = both(left.box.left, right.box.left), t.top = both(left.box.top, right.box.top);
    t.last_x = both(left.box.last_x, right.box.last_x), t.last_y = both(left.box.last_y, right.box.last_y);
    return ~mask_bits(set_up_edges(D{}, task, t, out, k));
  }
#endif
};

// The contract's edge functions in int64, so without the shift of rule 5. Steps are in units of rule 5, so
// that they fit 32 bits.
struct Int64Numbers : WideLanes<std::int64_t> {
  using Task = lab::EngineTask;
  using Depth = ContractDepth;
  using Edge = Linear<std::int64_t>;
  using Rule = ContractNumbers::Rule;
  static constexpr std::int32_t kMargin = 0;

  static HWY_INLINE Vector times(V count, Value step) {
#if HWY_TARGET == HWY_SCALAR
    return set(hn::GetLane(count) * step * contract::kSub);
#else
    const auto even = [](hn::Vec<Part> v) { return hn::BitCast(hn::Repartition<std::int32_t, Part>{}, v); };
    return each([&](int i) {
      const auto product = hn::MulEven(even(widened(count, i)), even(hn::Set(Part{}, step)));
      return hn::ShiftLeft<contract::kSubBits>(product);
    });
#endif
  }
  static HWY_INLINE Vector four_times(const Vector& v) {
    return each([&](int i) { return hn::ShiftLeft<2>(v.part[i]); });
  }
  static Rule rule(const Edge (&)[3], int) {
    return {};
  }
  static HWY_INLINE V outside(const Vector& e0, const Vector& e1, const Vector& e2, const Rule&) {
    return any_sign(e0, e1, e2);
  }
  static HWY_INLINE V negative(const Vector& e0, const Vector& e1, const Vector& e2) {
    return any_sign(e0, e1, e2);
  }
  static HWY_INLINE bool spans_more(Value span, std::int32_t twice_area_px) {
    return span >> 2 * contract::kSubBits > twice_area_px;
  }

  static bool set_up_one(const Task& task, std::uint32_t, const contract::Oriented& t, const BlockBox& box,
                         Edge (&out)[3], int k) {
    for (int i = 0; i < 3; ++i) {
      const EdgeInBox e(task, t, box, i);
      if (e.rejects) return false;
      const std::int64_t x = e.accepts ? 0 : e.a, y = e.accepts ? 0 : e.b, first = e.accepts ? 0 : e.first;
      const auto over_block = [](std::int64_t per_px) { return per_px * (kBlockSide - 1) * contract::kSub; };
      out[i].x[k] = x, out[i].y[k] = y, out[i].first[k] = first;
      out[i].rise[k] = over_block(std::max<std::int64_t>(x, 0) + std::max<std::int64_t>(y, 0));
      out[i].most[k] = first + out[i].rise[k];
      out[i].span[k] = over_block(std::abs(x) + std::abs(y));
    }
    return true;
  }

#if HWY_TARGET != HWY_SCALAR
  struct HalfEdges {
    struct {
      V32 x, y;
      V64 first;
    } edge[3];
  };
  static HWY_INLINE V64 set_up_half(const Task& task, const std::uint32_t*, const TriangleLanes& t,
                                    const Area& area, const BlockBoxLanes& box, HalfEdges& out) {
    V64 rejected = hn::Zero(D64{});
    for (int i = 0; i < 3; ++i) {
      const EdgeInBoxLanes e(task, t, area, box, i);
      rejected = hn::Or(rejected, e.most);
      const auto unless_accepted = [&](V64 v) { return hn::IfThenElseZero(e.crossed, v); };
      out.edge[i] = {lower(unless_accepted(as64(e.a))), lower(unless_accepted(as64(e.b))),
                     unless_accepted(e.first)};
    }
    return rejected;
  }
  static HWY_INLINE std::uint32_t store_edges(const Task&, const HalfEdges& left, const HalfEdges& right,
                                              Edge (&out)[3], int k) {
    for (int i = 0; i < 3; ++i) {
      store_half(left.edge[i], out[i], k);
      store_half(right.edge[i], out[i], k + kWidePart);
    }
    return ~0u;
  }

 private:
  static HWY_INLINE void store_half(const auto& half, Edge& out, int k) {
    const D64 d;
    const V32 zero = hn::Zero(D32{});
    const V64 rise =
        product(thrice(hn::Add(hn::Max(half.x, zero), hn::Max(half.y, zero))), set32(contract::kSub));
    const V64 span = product(thrice(hn::Add(hn::Abs(half.x), hn::Abs(half.y))), set32(contract::kSub));
    hn::StoreU(product(half.x, set32(1)), d, out.x + k), hn::StoreU(product(half.y, set32(1)), d, out.y + k);
    hn::StoreU(half.first, d, out.first + k), hn::StoreU(rise, d, out.rise + k);
    hn::StoreU(hn::Add(half.first, rise), d, out.most + k), hn::StoreU(span, d, out.span + k);
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

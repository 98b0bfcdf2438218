// Edge functions in floats or doubles, mostly from unsnapped vertices:
//   E(s) = (a s.x + b s.y) - (a p.x + b p.y),  a = p.y - q.y,  b = q.x - p.x
// at the box's first sample, in screen coordinates, as engines compute it that keep three coefficients per
// edge (Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). Re-based, the
// tile's corner is the origin. From there E is stepped by products of a and b with pixel distances.
//
// No value is -0, so its bits, as an integer, have its sign: a sum is -0 only if both terms are, and E at a
// box is not, because no sample has a coordinate 0.
#include <hwy/highway.h>

#include <cstdint>
#include <type_traits>

#include "edgewise/contract.h"
#include "lab/engine/engine_kernel.h"
#include "lab/engine/wide_lanes-inl.h"

// Included once per SIMD target.
#if defined(EDGEWISE_REAL_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EDGEWISE_REAL_NUMBERS_INL_H
#undef EDGEWISE_REAL_NUMBERS_INL_H
#else
#define EDGEWISE_REAL_NUMBERS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Samples with E = 0.
enum class OnEdge { accepted, rejected, top_left };
// Unsnapped ones come from a second record. Re-based ones are unsnapped, and relative to the tile's corner.
enum class Vertices { unsnapped, rebased, snapped };

struct DoubleLanes : WideLanes<double> {
  using Bits = WideLanes<std::int64_t>;
  static HWY_INLINE Vector times(V count, Value step) {
    return each([&](int i) { return hn::Mul(widened(count, i), hn::Set(Part{}, step)); });
  }
  static HWY_INLINE Vector four_times(const Vector& v) {
    return each([&](int i) { return hn::Mul(v.part[i], hn::Set(Part{}, 4.0)); });
  }
  static HWY_INLINE Bits::Vector bits(const Vector& v) {
    return Bits::each([&](int i) { return hn::BitCast(Bits::Part{}, v.part[i]); });
  }
};

template <class Lanes, OnEdge kOnEdge, Vertices kVertices>
struct RealNumbers : Lanes {
  using typename Lanes::Value;
  using typename Lanes::Vector;
  using Bits = typename Lanes::Bits;
  using Task = lab::EngineTask;
  using Depth = ContractDepth;
  static constexpr bool kReadsFloats = kVertices != Vertices::snapped;
  // An unsnapped vertex lies within half a sub-unit of the snapped one, on each axis.
  static constexpr std::int32_t kMargin = kReadsFloats ? 1 : 0;
  static constexpr bool kRebased = kVertices == Vertices::rebased;

  // `bias`: -1 where samples on the edge are outside, so that the bits of E = 0 become negative; else 0.
  struct Edge : Linear<Value> {
    typename Bits::Value bias[kBatch];
  };
  struct NoRule {};
  struct Biases {
    typename Bits::Value edge[3];
  };
  using Rule = std::conditional_t<kOnEdge == OnEdge::top_left, Biases, NoRule>;

  static HWY_INLINE Rule rule(const Edge (&edge)[3], int k) {
    if constexpr (kOnEdge == OnEdge::top_left)
      return {{edge[0].bias[k], edge[1].bias[k], edge[2].bias[k]}};
    else
      return {};
  }
  static HWY_INLINE V outside(const Vector& e0, const Vector& e1, const Vector& e2, const Rule& rule) {
    const auto b0 = Lanes::bits(e0), b1 = Lanes::bits(e1), b2 = Lanes::bits(e2);
    if constexpr (kOnEdge == OnEdge::top_left)
      return any_sign(Bits::add(b0, Bits::set(rule.edge[0])), Bits::add(b1, Bits::set(rule.edge[1])),
                      Bits::add(b2, Bits::set(rule.edge[2])));
    else if constexpr (kOnEdge == OnEdge::rejected)
      return hn::Sub(hn::Min(hn::Min(b0, b1), b2), hn::Set(D{}, 1));
    else
      return any_sign(b0, b1, b2);
  }
  static HWY_INLINE V negative(const Vector& e0, const Vector& e1, const Vector& e2) {
    return any_sign(Lanes::bits(e0), Lanes::bits(e1), Lanes::bits(e2));
  }
  static HWY_INLINE bool spans_more(Value span, std::int32_t twice_area_px) {
    return span > static_cast<Value>(twice_area_px) + 1;  // the area was rounded down
  }

  // A vector of triangles; all in px.
  template <class DF>
  struct Triangles {
    hn::Vec<DF> x[3], y[3];
    hn::Vec<DF> left, top, last_x, last_y;  // BlockBox
  };
  // Stores the edges from out.x[k] on. The mask is set where an edge rejects the box.
  template <class DF>
  static HWY_INLINE hn::Mask<DF> set_up_edges(DF df, const Task& task, const Triangles<DF>& t, Edge (&out)[3],
                                              int k) {
    using F = hn::Vec<DF>;
    const F zero = hn::Zero(df);
    const auto px = [&](int v) { return hn::Set(df, static_cast<Value>(v)); };
    // Snapped vertices are relative to the frame's corner.
    constexpr int kFromOrigin = kVertices == Vertices::snapped ? 0 : 1;
    const F corner_x = px(kFromOrigin * task.origin_x + task.x0),
            corner_y = px(kFromOrigin * task.origin_y + task.y0);
    const F half = hn::Set(df, Value{0.5f});
    F x[3], y[3], sample_x = hn::Add(t.left, half), sample_y = hn::Add(t.top, half);
    for (int i = 0; i < 3; ++i) {
      x[i] = kRebased ? hn::Sub(t.x[i], corner_x) : t.x[i];
      y[i] = kRebased ? hn::Sub(t.y[i], corner_y) : t.y[i];
    }
    if constexpr (!kRebased) sample_x = hn::Add(sample_x, corner_x), sample_y = hn::Add(sample_y, corner_y);

    const F area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                           hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
    const F flip = hn::And(area, hn::SignBit(df));
    auto rejected = hn::Eq(area, zero);
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const F a = hn::Xor(hn::Sub(y[i], y[j]), flip), b = hn::Xor(hn::Sub(x[j], x[i]), flip);
      const F first = hn::Sub(hn::Add(hn::Mul(a, sample_x), hn::Mul(b, sample_y)),
                              hn::Add(hn::Mul(a, x[i]), hn::Mul(b, y[i])));
      const F rises = hn::Add(hn::Mul(hn::Max(a, zero), t.last_x), hn::Mul(hn::Max(b, zero), t.last_y));
      const F falls = hn::Add(hn::Mul(hn::Min(a, zero), t.last_x), hn::Mul(hn::Min(b, zero), t.last_y));
      rejected = hn::Or(rejected, hn::Lt(hn::Add(first, rises), zero));
      store_edge(df, a, b, first, hn::Gt(hn::Add(first, falls), zero), out[i], k);
    }
    return rejected;
  }
  // An accepted edge becomes the constant 1, which no rule rejects.
  template <class DF>
  static HWY_INLINE void store_edge(DF df, hn::Vec<DF> a, hn::Vec<DF> b, hn::Vec<DF> first,
                                    hn::Mask<DF> accepted, Edge& out, int k) {
    store_functions(df, hn::IfThenZeroElse(accepted, a), hn::IfThenZeroElse(accepted, b),
                    hn::IfThenElse(accepted, hn::Set(df, Value{1}), first), out, k);
    if constexpr (kOnEdge == OnEdge::top_left) {
      const hn::RebindToSigned<DF> di;
      const auto zero = hn::Zero(df);
      const auto top_left = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
      hn::StoreU(hn::IfThenZeroElse(hn::RebindMask(di, top_left), hn::Set(di, -1)), di, out.bias + k);
    }
  }

  // From sub-units.
  template <class DF>
  static HWY_INLINE hn::Vec<DF> in_px(DF df, hn::Vec<DF> v) {
    return hn::Mul(v, hn::Set(df, Value{1} / contract::kSub));
  }

  static bool set_up_one(const Task& task, std::uint32_t index, const contract::Oriented&,
                         const BlockBox& box, Edge (&out)[3], int k) {
    const hn::CappedTag<Value, 1> df;
    const auto set = [&](auto v) { return hn::Set(df, static_cast<Value>(v)); };
    Triangles<hn::CappedTag<Value, 1>> t;
    for (int i = 0; i < 3; ++i) {
      if constexpr (kVertices == Vertices::snapped) {
        t.x[i] = in_px(df, set(task.triangles[index].x_sub[i]));
        t.y[i] = in_px(df, set(task.triangles[index].y_sub[i]));
      } else {
        t.x[i] = set(task.floats[index].at.x_px[i]), t.y[i] = set(task.floats[index].at.y_px[i]);
      }
    }
    t.left = set(box.left), t.top = set(box.top), t.last_x = set(box.last_x), t.last_y = set(box.last_y);
    return hn::AllFalse(df, set_up_edges(df, task, t, out, k));
  }

#if HWY_TARGET != HWY_SCALAR
  using HalfEdges = HalfPositions;
  static HWY_INLINE V64 set_up_half(const Task& task, const std::uint32_t* indices,
                                    const TriangleLanes& snapped, const Area&, const BlockBoxLanes& box,
                                    HalfEdges& out) {
    const TriangleLanes t = kVertices == Vertices::snapped ? snapped : load(task.floats, indices);
    for (int i = 0; i < 3; ++i) out.x[i] = t.x[i], out.y[i] = t.y[i];
    out.box = box;
    return hn::Zero(D64{});
  }
  static HWY_INLINE std::uint32_t store_edges(const Task& task, const HalfEdges& left, const HalfEdges& right,
                                              Edge (&out)[3], int k) {
    if constexpr (std::is_same_v<Value, float>) {
      const FloatLanes::Floats df;
      const auto whole = [&](V32 l, V32 r) { return hn::ConvertTo(df, both(l, r)); };
      const auto real = [&](V32 l, V32 r) {
        if constexpr (kVertices == Vertices::snapped)
          return in_px(df, whole(l, r));
        else
          return hn::BitCast(df, both(l, r));
      };
      Triangles<FloatLanes::Floats> t;
      for (int i = 0; i < 3; ++i) t.x[i] = real(left.x[i], right.x[i]), t.y[i] = real(left.y[i], right.y[i]);
      t.left = whole(left.box.left, right.box.left), t.top = whole(left.box.top, right.box.top);
      t.last_x = whole(left.box.last_x, right.box.last_x),
      t.last_y = whole(left.box.last_y, right.box.last_y);
      return ~mask_bits(hn::RebindMask(D{}, set_up_edges(df, task, t, out, k)));
    } else {
      return ~(store_half(task, left, out, k) | store_half(task, right, out, k + kWidePart) << kWidePart);
    }
  }

 private:
  static_assert(std::is_same_v<Value, float> || kVertices != Vertices::snapped);
  static HWY_INLINE std::uint32_t store_half(const Task& task, const HalfEdges& half, Edge (&out)[3], int k) {
    const F64 df;
    const auto packed = [](V32 v) { return hn::TruncateTo(Low32{}, hn::BitCast(U64{}, as64(v))); };
    const auto real = [&](V32 v) {
      return hn::PromoteTo(df, hn::BitCast(hn::Rebind<float, F64>{}, packed(v)));
    };
    const auto whole = [&](V32 v) {
      return hn::PromoteTo(df, hn::BitCast(hn::Rebind<std::int32_t, F64>{}, packed(v)));
    };
    Triangles<F64> t;
    for (int i = 0; i < 3; ++i) t.x[i] = real(half.x[i]), t.y[i] = real(half.y[i]);
    t.left = whole(half.box.left), t.top = whole(half.box.top);
    t.last_x = whole(half.box.last_x), t.last_y = whole(half.box.last_y);
    return mask_bits(hn::RebindMask(D64{}, set_up_edges(df, task, t, out, k)));
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#endif

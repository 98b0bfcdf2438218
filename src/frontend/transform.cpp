// Transforms a vector of vertices at a time, with one vector per coordinate and no branch. If a vertex is not
// finite or needs clipping, its screen position is computed too, but is meaningless.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/lanes-inl.h"

#include <algorithm>
#include <limits>

#include "core/kernel_table.h"
#include "frontend/transform.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// Positions less the transform's origin.
struct Offsets {
  VF x, y, z;
};

struct ClipVectors {
  VF x, y, z, w;
  VF beyond;  // z - w, if z is not w
};

HWY_INLINE Offsets from_origin(const ScreenTransform& to_screen, const float* positions) {
  const DF d;
  VF x, y, z;
  hn::LoadInterleaved3(d, positions, x, y, z);
  return {hn::Sub(x, hn::Set(d, to_screen.origin.x)), hn::Sub(y, hn::Set(d, to_screen.origin.y)),
          hn::Sub(z, hn::Set(d, to_screen.origin.z))};
}

template <class Doubles>
HWY_INLINE Doubles row_of_doubles(const glm::dvec4& r, Doubles x, Doubles y, Doubles z) {
  const hn::DFromV<Doubles> d;
  const Doubles xy = hn::Add(hn::Mul(hn::Set(d, r.x), x), hn::Mul(hn::Set(d, r.y), y));
  return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, r.z), z)), hn::Set(d, r.w));
}

template <bool kHasZ>
HWY_INLINE ClipVectors transform(const ScreenTransform& to_screen, const Offsets& p) {
  const DF d;
  const glm::mat4x3& m = to_screen.rounded;
  const auto row = [&](int r) HWY_ATTR {
    const VF xy = hn::Add(hn::Mul(hn::Set(d, m[0][r]), p.x), hn::Mul(hn::Set(d, m[1][r]), p.y));
    return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, m[2][r]), p.z)), hn::Set(d, m[3][r]));
  };
  const VF w = row(2);
  if constexpr (kHasZ) {
    // Clamped, since conversions beyond the range of float differ between targets.
    const auto clamped = [&](const glm::dvec4& r) HWY_ATTR {
      const auto value = [&](auto x, auto y, auto z) HWY_ATTR {
        const auto limit = hn::Set(hn::DFromV<decltype(x)>{}, double{std::numeric_limits<float>::max()});
        return hn::Min(hn::Max(row_of_doubles(r, x, y, z), hn::Neg(limit)), limit);
      };
      return in_double(d, value, p.x, p.y, p.z);
    };
    return {row(0), row(1), clamped(to_screen.z), w, clamped(to_screen.z - to_screen.w)};
  } else {
    return {row(0), row(1), w, w, w};
  }
}

// z / w in contract units.
HWY_INLINE V quotient_depth(const ScreenTransform& to_screen, const Offsets& p) {
  const auto units = [&](auto x, auto y, auto z) HWY_ATTR {
    const hn::DFromV<decltype(x)> d;
    const auto range = hn::Set(d, double{contract::kDepthRange});
    const auto exact =
        hn::Mul(hn::Div(row_of_doubles(to_screen.z, x, y, z), row_of_doubles(to_screen.w, x, y, z)), range);
    return hn::Min(hn::Max(exact, hn::Zero(d)), range);
  };
  return round_depth(units, p.x, p.y, p.z);
}

// outside_of() of clip.h, for float coordinates. 16384 w is exact, and if it overflows, the infinity compares
// correctly.
template <bool kHasZ>
HWY_INLINE V outside_of(const ClipVectors& v, const ViewVolume& view) {
  const DF df;
  const D di;
  V sides = hn::Zero(di);
  const auto add_side = [&](auto beyond, Outside side) HWY_ATTR {
    sides = hn::Or(sides, hn::IfThenElseZero(hn::RebindMask(di, beyond), hn::Set(di, side)));
  };
  const VF zero = hn::Zero(df);
  const VF guard = hn::Mul(v.w, hn::Set(df, static_cast<float>(contract::kMaxImageSide)));
  // Far away, w rounded to float may lie on either side of z.
  const auto beyond_far =
      kHasZ ? hn::Gt(v.beyond, zero) : hn::Gt(v.z, hn::Set(df, static_cast<float>(view.far_z)));
  add_side(hn::Lt(v.z, hn::Set(df, static_cast<float>(view.near_z))), kNear);
  add_side(beyond_far, kFar);
  add_side(hn::Lt(v.x, hn::Neg(guard)), kGuardLeft);
  add_side(hn::Gt(v.x, guard), kGuardRight);
  add_side(hn::Lt(v.y, hn::Neg(guard)), kGuardTop);
  add_side(hn::Gt(v.y, guard), kGuardBottom);
  add_side(hn::Lt(v.x, zero), kLeft);
  add_side(hn::Gt(v.x, hn::Mul(hn::Set(df, static_cast<float>(view.width_px)), v.w)), kRight);
  add_side(hn::Lt(v.y, zero), kTop);
  add_side(hn::Gt(v.y, hn::Mul(hn::Set(df, static_cast<float>(view.height_px)), v.w)), kBottom);
  const auto finite = hn::And(hn::And(hn::IsFinite(v.x), hn::IsFinite(v.y)), hn::IsFinite(v.w));
  return hn::IfThenElse(hn::RebindMask(di, finite), sides, hn::Set(di, kNotFinite));
}

// Transforms a whole vector of vertices. Returns the sides that each lies beyond; all bits if not finite.
template <bool kHasZ>
HWY_INLINE V transform_vector(const MeshTask& task, const float* positions, Vertex* out) {
  const DF df;
  const D di;
  const Offsets p = from_origin(task.to_screen, positions);
  const ClipVectors v = transform<kHasZ>(task.to_screen, p);
  V outside = outside_of<kHasZ>(v, task.view);
  const VF inverse_w = hn::Div(hn::Set(df, 1.0f), v.w);
  // Not where near_z is subnormal.
  const auto projectable = hn::IsFinite(inverse_w);
  const auto inside = hn::Eq(hn::And(outside, hn::Set(di, kMustClip | kNotFinite)), hn::Zero(di));
  const auto needs_clipper = hn::AndNot(hn::RebindMask(di, projectable), inside);
  outside = hn::Or(outside, hn::IfThenElseZero(needs_clipper, hn::Set(di, kNear)));
  const V depth = kHasZ ? quotient_depth(task.to_screen, p) : view_depth(task.depth, v.w);
  hn::StoreInterleaved4(snap(hn::Mul(v.x, inverse_w)), snap(hn::Mul(v.y, inverse_w)), depth, outside, di,
                        reinterpret_cast<std::int32_t*>(out));
  return hn::IfThenElse(hn::Eq(outside, hn::Set(di, kNotFinite)), hn::Set(di, -1), outside);
}

template <bool kHasZ>
std::uint32_t transform_all(const MeshTask& task, const glm::vec3* positions, std::size_t count,
                            Vertex* out) {
  const D d;
  V common = hn::Set(d, -1);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    common = hn::And(common, transform_vector<kHasZ>(task, &positions[i].x, out + i));
  if (i < count) {
    glm::vec3 padded[kLanes];
    Vertex vertices[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) padded[lane] = positions[std::min(i + lane, count - 1)];
    common = hn::And(common, transform_vector<kHasZ>(task, &padded[0].x, vertices));
    std::copy_n(vertices, count - i, out + i);
  }
  std::int32_t lanes[kLanes];
  hn::StoreU(common, d, lanes);
  for (const std::int32_t lane : lanes) lanes[0] &= lane;
  return static_cast<std::uint32_t>(lanes[0]);
}

std::uint32_t transform_vertices(const MeshTask& task, const glm::vec3* positions, std::size_t count,
                                 Vertex* out) {
  return task.to_screen.has_z ? transform_all<true>(task, positions, count, out)
                              : transform_all<false>(task, positions, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(TransformKernel, transform_kernel, transform_vertices)
#endif

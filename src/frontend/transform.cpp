// Transforms a vector of vertices at a time, with one vector per coordinate and no branch. If a vertex is not
// finite or needs clipping, its screen position is computed too, but is meaningless.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frontend/transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This needs Highway first.
#include "frontend/lanes-inl.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include "core/kernel_table.h"
#include "frontend/transform.h"

HWY_BEFORE_NAMESPACE();
namespace edgewise {
namespace HWY_NAMESPACE {

// Positions less the transform's origin.
struct Offsets {
  VF x, y, z;
};

template <class Reals>
struct ClipVectors {
  Reals x, y, z, w, beyond;  // beyond: z - w; without kHasZ, z is w, and `beyond` unused
};

HWY_INLINE Offsets from_origin(const ScreenTransform& to_screen, const float* positions) {
  const DF d;
  VF x, y, z;
  hn::LoadInterleaved3(d, positions, x, y, z);
  const glm::vec3 origin(to_screen.origin);
  return {hn::Sub(x, hn::Set(d, origin.x)), hn::Sub(y, hn::Set(d, origin.y)),
          hn::Sub(z, hn::Set(d, origin.z))};
}

template <class Doubles>
HWY_INLINE Doubles row_of_doubles(const glm::dvec4& r, Doubles x, Doubles y, Doubles z) {
  const hn::DFromV<Doubles> d;
  const Doubles xy = hn::Add(hn::Mul(hn::Set(d, r.x), x), hn::Mul(hn::Set(d, r.y), y));
  return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, r.z), z)), hn::Set(d, r.w));
}

template <bool kHasZ>
HWY_INLINE ClipVectors<VF> transform(const ScreenTransform& to_screen, const Offsets& p) {
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
    return within_range(
        hn::Mul(hn::Div(row_of_doubles(to_screen.z, x, y, z), row_of_doubles(to_screen.w, x, y, z)), range));
  };
  return round_depth(units, p.x, p.y, p.z);
}

// outside_of() of clip.h, and kNear where 1 / w is not finite, as it may be if near_z is subnormal. 16384 w
// is exact, and if it overflows, the infinity compares correctly.
template <bool kHasZ, class Reals, class Tag = hn::RebindToSigned<hn::DFromV<Reals> > >
HWY_INLINE hn::Vec<Tag> outside_of(const ClipVectors<Reals>& v, Reals inverse_w, const ViewVolume& view) {
  const hn::DFromV<Reals> df;
  using T = hn::TFromD<decltype(df)>;
  const Tag di;
  auto sides = hn::Zero(di);
  const auto add_side = [&](auto beyond, Outside side) HWY_ATTR {
    sides = hn::Or(sides, hn::IfThenElseZero(hn::RebindMask(di, beyond), hn::Set(di, side)));
  };
  const auto real = [&](double r) HWY_ATTR { return hn::Set(df, static_cast<T>(r)); };
  const Reals zero = hn::Zero(df);
  const Reals guard = hn::Mul(v.w, real(contract::kMaxImageSide));
  // Far away, w rounded to float may lie on either side of z.
  const auto beyond_far = kHasZ ? hn::Gt(v.beyond, zero) : hn::Gt(v.z, real(view.far_z));
  add_side(hn::Lt(v.z, real(view.near_z)), kNear);
  add_side(beyond_far, kFar);
  add_side(hn::Lt(v.x, hn::Neg(guard)), kGuardLeft);
  add_side(hn::Gt(v.x, guard), kGuardRight);
  add_side(hn::Lt(v.y, hn::Neg(guard)), kGuardTop);
  add_side(hn::Gt(v.y, guard), kGuardBottom);
  add_side(hn::Lt(v.x, zero), kLeft);
  add_side(hn::Gt(v.x, hn::Mul(real(view.width_px), v.w)), kRight);
  add_side(hn::Lt(v.y, zero), kTop);
  add_side(hn::Gt(v.y, hn::Mul(real(view.height_px), v.w)), kBottom);
  const auto projectable = hn::RebindMask(di, hn::IsFinite(inverse_w));
  const auto inside = hn::Eq(hn::And(sides, hn::Set(di, kMustClip)), hn::Zero(di));
  sides = hn::Or(sides, hn::IfThenElseZero(hn::AndNot(projectable, inside), hn::Set(di, kNear)));
  const auto finite = hn::And(hn::And(hn::IsFinite(v.x), hn::IsFinite(v.y)), hn::IsFinite(v.w));
  return hn::IfThenElse(hn::RebindMask(di, finite), sides, hn::Set(di, kNotFinite));
}

// Projects and snaps a whole vector of vertices: the words of Vertex.
template <bool kHasZ>
HWY_INLINE Words project(const MeshTask& task, const float* positions) {
  const Offsets p = from_origin(task.to_screen, positions);
  const ClipVectors<VF> v = transform<kHasZ>(task.to_screen, p);
  const VF inverse_w = hn::Div(hn::Set(DF{}, 1.0f), v.w);
  const int bits = task.options.subpixel_bits;
  const V depth = kHasZ ? quotient_depth(task.to_screen, p) : view_depth(task.depth, v.w);
  return {{snap(hn::Mul(v.x, inverse_w), bits), snap(hn::Mul(v.y, inverse_w), bits), depth,
           outside_of<kHasZ>(v, inverse_w, task.view)}};
}

// The same in double, for fine positions.
template <bool kHasZ>
HWY_INLINE Words project_in_double(const MeshTask& task, const float* positions) {
  VF position_x, position_y, position_z;
  hn::LoadInterleaved3(DF{}, positions, position_x, position_y, position_z);
  const auto words = [&](auto x, auto y, auto z) HWY_ATTR {
    using Doubles = decltype(x);
    const hn::DFromV<Doubles> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto real = [&](double r) HWY_ATTR { return hn::Set(d, r); };
    const ScreenTransform& m = task.to_screen;
    x = hn::Sub(x, real(m.origin.x)), y = hn::Sub(y, real(m.origin.y)), z = hn::Sub(z, real(m.origin.z));
    const auto row = [&](int r) HWY_ATTR {
      return row_of_doubles({m.exact[0][r], m.exact[1][r], m.exact[2][r], m.exact[3][r]}, x, y, z);
    };
    ClipVectors<Doubles> v{row(0), row(1), row(2), row(2), row(2)};
    if constexpr (kHasZ) v.z = row_of_doubles(m.z, x, y, z), v.beyond = hn::Sub(v.z, v.w);
    const Doubles inverse_w = hn::Div(real(1.0), v.w);
    const Doubles round_px = real(rounding_to(task.options.subpixel_bits));
    const auto snapped = [&](Doubles xw) HWY_ATTR {
      const Doubles px = hn::Sub(hn::Add(hn::Mul(xw, inverse_w), round_px), round_px);
      return hn::Mul(px, real(contract::kPixel_q15));
    };
    const Doubles above_near = kHasZ ? hn::Mul(v.z, real(contract::kDepthRange))
                                     : hn::Mul(hn::Sub(v.w, real(task.depth.near_z)), real(task.depth.scale));
    const auto outside = hn::BitCast(di, real(0x1p52));
    return std::array{
        snapped(v.x), snapped(v.y), whole_units(within_range(hn::Mul(above_near, inverse_w))),
        hn::Sub(hn::BitCast(d, hn::Or(outside, outside_of<kHasZ>(v, inverse_w, task.view))), real(0x1p52))};
  };
  Words vertices = words_in_double(words, position_x, position_y, position_z);
  vertices.word[2] = above_head_room(vertices.word[2]);
  return vertices;
}

// Transforms a whole vector of vertices. Returns the sides that each lies beyond; all bits if not finite.
template <bool kHasZ, bool kFine>
HWY_INLINE V transform_vector(const MeshTask& task, const float* positions, Vertex* out) {
  const Words vertices = kFine ? project_in_double<kHasZ>(task, positions) : project<kHasZ>(task, positions);
  const V outside = vertices.word[3];
  hn::StoreInterleaved4(vertices.word[0], vertices.word[1], vertices.word[2], outside, D{},
                        reinterpret_cast<std::int32_t*>(out));
  return hn::IfThenElse(hn::Eq(outside, hn::Set(D{}, kNotFinite)), hn::Set(D{}, -1), outside);
}

template <bool kHasZ, bool kFine>
std::uint32_t transform_all(const MeshTask& task, const glm::vec3* positions, std::size_t count,
                            Vertex* out) {
  const D d;
  V common = hn::Set(d, -1);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    common = hn::And(common, transform_vector<kHasZ, kFine>(task, &positions[i].x, out + i));
  if (i < count) {
    glm::vec3 padded[kLanes];
    Vertex vertices[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) padded[lane] = positions[std::min(i + lane, count - 1)];
    common = hn::And(common, transform_vector<kHasZ, kFine>(task, &padded[0].x, vertices));
    std::copy_n(vertices, count - i, out + i);
  }
  std::int32_t lanes[kLanes];
  hn::StoreU(common, d, lanes);
  for (const std::int32_t lane : lanes) lanes[0] &= lane;
  return static_cast<std::uint32_t>(lanes[0]);
}

std::uint32_t transform_vertices(const MeshTask& task, const glm::vec3* positions, std::size_t count,
                                 Vertex* out) {
  const auto all = [&](auto has_z) {
    return task.is_fine() ? transform_all<has_z(), true>(task, positions, count, out)
                          : transform_all<has_z(), false>(task, positions, count, out);
  };
  return task.to_screen.has_z ? all(std::true_type()) : all(std::false_type());
}

}  // namespace HWY_NAMESPACE
}  // namespace edgewise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
EDGEWISE_DEFINE_KERNEL(TransformKernel, transform_kernel, transform_vertices)
#endif
